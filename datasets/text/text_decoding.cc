#include <datasets/files/input_file.h>
#include <datasets/system/error.h>
#include <datasets/text/text_decoding.h>

#include <fmt/format.h>

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>

namespace swimtwin
{
  namespace
  {
    using namespace std::string_view_literals;

    struct Encoding
    {
      const char      *name;
      std::string_view mark; ///< byte order mark
    };

    // UTF-32 before UTF-16, whose mark it contains.
    constexpr std::array<Encoding, 5> marked{{{"UTF-32LE", "\xFF\xFE\0\0"sv},
                                              {"UTF-32BE", "\0\0\xFE\xFF"sv},
                                              {"UTF-8", "\xEF\xBB\xBF"sv},
                                              {"UTF-16LE", "\xFF\xFE"sv},
                                              {"UTF-16BE", "\xFE\xFF"sv}}};

    /// One conversion by the C library.
    class Converter
    {
    public:
      explicit Converter(const char *from) : handle_(iconv_open("UTF-8", from)) {}
      Converter(const Converter &)            = delete;
      Converter &operator=(const Converter &) = delete;
      ~Converter()
      {
        if (is_open())
          iconv_close(handle_);
      }

      /// None for bytes that are none of the encoding's, or when the system does not know it.
      std::optional<std::string> convert(const std::string_view bytes) const
      {
        if (!is_open())
          return std::nullopt;
        std::string text(4 * bytes.size() + 4, '\0'); // UTF-8 takes at most three bytes for one or two
        std::string in(bytes);
        char       *from = in.data(), *to = text.data();
        std::size_t n_from = in.size(), n_to = text.size();
        if (iconv(handle_, &from, &n_from, &to, &n_to) == static_cast<std::size_t>(-1))
          return std::nullopt;
        text.resize(text.size() - n_to);
        return text;
      }

    private:
      bool is_open() const { return handle_ != reinterpret_cast<iconv_t>(-1); }

      iconv_t handle_;
    };

    std::optional<std::string> converted(const std::string_view bytes, const char *from)
    {
      return Converter(from).convert(bytes);
    }

    bool is_ascii(const std::string_view bytes)
    {
      return std::all_of(bytes.begin(), bytes.end(), [](const char c) { return static_cast<unsigned char>(c) < 0x80; });
    }

    /// UTF-16 without its mark: most characters of a table are ASCII, so that every other byte is NUL.
    const char *unmarked_utf16(const std::string_view bytes)
    {
      std::array<std::size_t, 2> n_zero{};
      for (std::size_t i = 0; i < bytes.size(); ++i)
        n_zero[i % 2] += bytes[i] == '\0' ? 1u : 0u;
      const std::size_t most = 2 * bytes.size() / 5;
      if (n_zero[1] > most && n_zero[0] == 0)
        return "UTF-16LE";
      return n_zero[0] > most && n_zero[1] == 0 ? "UTF-16BE" : nullptr;
    }

    void refuse_nul(const std::string_view text, const std::filesystem::path &file)
    {
      const auto at = text.find('\0');
      if (at == std::string_view::npos)
        return;
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      throw InputError(
          fmt::format("{}:{}: there are NUL bytes, so this is binary data or a text that was not written to "
                      "its end; export the table as CSV again.",
                      file.string(), line));
    }

    std::string with_line_feeds(std::string text)
    {
      if (text.find('\r') == std::string::npos)
        return text;
      std::string lines;
      lines.reserve(text.size());
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] != '\r')
          lines += text[i];
        else if (i + 1 == text.size() || text[i + 1] != '\n')
          lines += '\n';
      return lines;
    }

    /// Of the character in UTF-8 that a text begins with, in bytes; 0 if it is none.
    std::size_t length_of_character(const std::string_view text)
    {
      const auto        first = static_cast<unsigned char>(text.front());
      const std::size_t n     = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
      return n == 1 || converted(text.substr(0, n), "UTF-8") ? n : 0;
    }

    /// What one byte is in Windows-1252, or where that has nothing in Latin-1.
    std::string character_of(const std::string_view byte)
    {
      const auto text = converted(byte, "WINDOWS-1252");
      return text ? *text : converted(byte, "ISO-8859-1").value_or("?");
    }

    /// Bytes that are no UTF-8 are Windows-1252: all of them, or those that another program put into a text in UTF-8.
    std::string without_foreign_bytes(const std::string_view bytes)
    {
      std::string text;
      for (std::size_t i = 0; i < bytes.size();)
        if (const std::size_t n = length_of_character(bytes.substr(i)); n > 0)
        {
          text += bytes.substr(i, n);
          i += n;
        }
        else
          text += character_of(bytes.substr(i++, 1));
      return text;
    }

    std::string as_utf8(std::string_view bytes, const std::filesystem::path &file)
    {
      const auto found =
          std::find_if(marked.begin(), marked.end(), [&](const Encoding &e) { return bytes.starts_with(e.mark); });
      const char *encoding = found == marked.end() ? unmarked_utf16(bytes) : found->name;
      if (found != marked.end())
        bytes.remove_prefix(found->mark.size());
      if (encoding != nullptr && std::strcmp(encoding, "UTF-8") != 0)
      {
        const auto text = converted(bytes, encoding);
        if (!text)
          throw InputError(fmt::format("{}: this is text in {} that is cut or damaged; save it again, as UTF-8.",
                                       file.string(), encoding));
        return *text;
      }
      if (is_ascii(bytes))
        return std::string(bytes);
      const auto text = converted(bytes, "UTF-8");
      return text ? *text : without_foreign_bytes(bytes);
    }
  } // namespace

  std::string decoded_text(const std::string_view bytes, const std::filesystem::path &file)
  {
    std::string text = as_utf8(bytes, file);
    refuse_nul(text, file);
    return with_line_feeds(std::move(text));
  }

  std::string read_decoded_text(const std::filesystem::path &file, const std::string &what)
  {
    return decoded_text(read_text_file(file, what), file);
  }
} // namespace swimtwin
