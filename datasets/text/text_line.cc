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
} // namespace swimtwin
