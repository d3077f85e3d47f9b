#include <datasets/text/text_line.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    bool is_control_character(const char c)
    {
      const auto byte = static_cast<unsigned char>(c);
      return byte < 0x20 || byte == 0x7f;
    }

    std::string valid_utf8(const std::string &text)
    {
      using nlohmann::json;
      return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
    }
  } // namespace

  std::string text_line(const std::string &text)
  {
    std::string line = valid_utf8(text);
    std::replace_if(line.begin(), line.end(), is_control_character, ' ');
    return line;
  }

  std::string shortened(const std::string &text)
  {
    constexpr std::size_t most = 40;
    if (text.size() <= most)
      return text;
    std::size_t n = most;
    while (n > 0 && (static_cast<unsigned char>(text[n]) & 0xC0U) == 0x80U) // inside a character
      --n;
    return text.substr(0, n) + "...";
  }
} // namespace swimtwin
