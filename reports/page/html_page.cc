#include <reports/page/html_page.h>

#include <datasets/text/csv_table.h>

#include <fmt/format.h>
#include <openssl/evp.h>

#include <cctype>

namespace swimtwin
{
  namespace
  {
    constexpr std::string_view style = R"css(
:root { color-scheme: light dark; --text: #26262b; --pale: #5f6673; --line: #d5d9df; --page: #fff; --link: #1d4e89;
  --good: #e3f3ea; --bad: #fbe0e2; --warning: #fdf1d8; }
@media (prefers-color-scheme: dark) { :root { --text: #e4e6ea; --pale: #a3aab6; --line: #41464f; --page: #17191d;
  --link: #8ab8ee; --good: #17402b; --bad: #5a1f27; --warning: #4b3a12; } }
body { max-width: 62rem; margin: 2rem auto; padding: 0 1.2rem; background: var(--page); color: var(--text);
  font: 16px/1.5 "DejaVu Sans", system-ui, sans-serif; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.15rem; margin-top: 2.2rem; }
a { color: var(--link); }
.verdict, .warning { padding: .6rem .9rem; border-radius: .3rem; overflow-wrap: anywhere; }
.verdict { font-weight: bold; }
.good { background: var(--good); } .bad { background: var(--bad); } .warning { background: var(--warning); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .9rem .2rem 0; border-bottom: 1px solid var(--line); text-align: right;
  vertical-align: top; }
th { font-weight: normal; color: var(--pale); }
th:first-child { text-align: left; } tbody th { color: var(--text); }
.texts td { text-align: left; overflow-wrap: anywhere; }
img { display: block; max-width: 100%; height: auto; margin: 1rem 0; border: 1px solid var(--line); background: #fff; }
pre { padding: .8rem; border: 1px solid var(--line); font-size: .85rem; white-space: pre-wrap; overflow-wrap: anywhere; }
@media print { body { max-width: none; margin: 0; font-size: 10pt; } h2 { break-after: avoid; }
  img, tr, .verdict { break-inside: avoid; } .wide { overflow: visible; }
  .verdict, .warning { border: 1px solid #000; } }
)css";

    std::string content_of(const HtmlCell &cell)
    {
      if (cell.target.empty())
        return escaped(cell.text);
      return fmt::format("<a href=\"{}\">{}</a>", escaped(cell.target), escaped(cell.text));
    }

    std::string row_text(const std::vector<HtmlCell> &cells)
    {
      std::string row;
      for (const HtmlCell &cell : cells)
        row += row.empty() ? fmt::format("<th scope=\"row\">{}</th>", content_of(cell))
                           : fmt::format("<td>{}</td>", content_of(cell));
      return fmt::format("<tr>{}</tr>\n", row);
    }

    std::string header_text(const std::vector<std::string> &names)
    {
      std::string row;
      for (const std::string &name : names)
        row += fmt::format("<th scope=\"col\">{}</th>", escaped(name));
      return names.empty() ? "" : fmt::format("<thead><tr>{}</tr></thead>\n", row);
    }
  } // namespace

  std::string escaped(const std::string_view text)
  {
    std::string result;
    for (const char c : text)
      switch (c)
      {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
      }
    return result;
  }

  std::string base64(const std::string_view bytes)
  {
    std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0'); // libcrypto ends it with a zero
    const int   n =
        EVP_EncodeBlock(reinterpret_cast<unsigned char *>(text.data()),
                        reinterpret_cast<const unsigned char *>(bytes.data()), static_cast<int>(bytes.size()));
    text.resize(static_cast<std::size_t>(n));
    return text;
  }

  std::string link_target(const std::filesystem::path &path)
  {
    std::string target;
    for (const char c : path.generic_string())
    {
      const auto byte = static_cast<unsigned char>(c);
      if (std::isalnum(byte) != 0 || std::string_view("/._-~").find(c) != std::string_view::npos)
        target += c;
      else
        target += fmt::format("%{:02X}", byte);
    }
    return target;
  }

  HtmlPage::HtmlPage(const std::string &title) : title_(title)
  {
    add_element("h1", "", title);
  }

  void HtmlPage::add_element(const std::string_view name, const std::string_view attributes,
                             const std::string_view text)
  {
    body_ += fmt::format("<{0}{1}>{2}</{0}>\n", name, attributes, escaped(text));
  }

  void HtmlPage::add_verdict(const Verdict verdict, const std::string_view text)
  {
    add_element("p", verdict == Verdict::good ? " class=\"verdict good\"" : " class=\"verdict bad\"", text);
  }

  void HtmlPage::add_warning(const std::string_view text)
  {
    add_element("p", " class=\"warning\"", text);
  }

  void HtmlPage::add_warnings(const std::vector<std::string> &texts)
  {
    for (const std::string &text : texts)
      add_warning(text);
  }

  void HtmlPage::add_heading(const std::string_view text)
  {
    add_element("h2", "", text);
  }

  void HtmlPage::add_paragraph(const std::string_view text)
  {
    add_element("p", "", text);
  }

  void HtmlPage::add_preformatted(const std::string_view text)
  {
    add_element("pre", "", text);
  }

  void HtmlPage::add_table(const HtmlTable &table)
  {
    body_ += fmt::format("<div class=\"wide\"><table{}>\n{}<tbody>\n", table.of_texts ? " class=\"texts\"" : "",
                         header_text(table.header));
    for (const std::vector<HtmlCell> &cells : table.rows)
      body_ += row_text(cells);
    body_ += "</tbody></table></div>\n";
  }

  void HtmlPage::add_picture(const std::filesystem::path &png, const std::string_view description)
  {
    body_ += fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\"/>\n", escaped(description),
                         base64(read_text_file(png, "the picture")));
  }

  std::string HtmlPage::text() const
  {
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                       "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
                       escaped(title_), style, body_);
  }
} // namespace swimtwin
