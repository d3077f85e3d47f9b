#include <datasets/scene/scene_field.h>

#include <fmt/format.h>

#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::string without_field(const std::string &scene_text)
    {
      std::istringstream lines(scene_text);
      std::string        text, line;
      bool               in_field = false;
      while (std::getline(lines, line))
      {
        if (line.starts_with("["))
          in_field = line.starts_with("[field]");
        if (!in_field)
          text += line + "\n";
      }
      return text;
    }
  } // namespace

  std::string with_field_program(const std::string &scene_text, const std::string &program, const double period_s)
  {
    return without_field(scene_text) +
           fmt::format("\n[field]\nprogram = \"{}\"\nperiod_s = {:.17g}\n", program, period_s);
  }
} // namespace swimtwin
