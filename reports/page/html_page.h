// A self-contained HTML page: headings, tables and pictures in one file that asks the network for nothing.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  /// Text as it has to stand in an element or in a quoted attribute.
  std::string escaped(std::string_view text);

  /// RFC 4648, padded, without line breaks.
  std::string base64(std::string_view bytes);

  /// A relative path as the target of a link.
  std::string link_target(const std::filesystem::path &path);

  struct HtmlCell
  {
    std::string text, target = {}; ///< a link if it has a target
  };

  struct HtmlTable
  {
    std::vector<std::string>           header;           ///< may be empty
    std::vector<std::vector<HtmlCell>> rows;             ///< the first cell of a row names it
    bool                               of_texts = false; ///< to the left; numbers stand to the right
  };

  enum class Verdict { good, bad };

  /// Everything is added in the order of the page; texts are escaped here.
  class HtmlPage
  {
  public:
    explicit HtmlPage(const std::string &title);

    void add_verdict(Verdict verdict, std::string_view text);
    void add_warning(std::string_view text);
    void add_warnings(const std::vector<std::string> &texts);
    void add_heading(std::string_view text);
    void add_paragraph(std::string_view text);
    void add_table(const HtmlTable &table);
    void add_preformatted(std::string_view text);
    /// The PNG file becomes a part of the page.
    void add_picture(const std::filesystem::path &png, std::string_view description);

    std::string text() const;

  private:
    void add_element(std::string_view name, std::string_view attributes, std::string_view text);

    std::string title_, body_;
  };
} // namespace swimtwin
