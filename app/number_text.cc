#include <app/number_text.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    std::string with_minus_signs(std::string text)
    {
      for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-'))
        text.replace(at, 1, "−");
      return text;
    }
  } // namespace

  // adding zero turns -0 into 0

  std::string plain_number(const double value, const int n_digits)
  {
    return std::isfinite(value) ? with_minus_signs(fmt::format("{:.{}g}", value + 0., n_digits)) : "not finite";
  }

  std::string signed_number(const double value, const int n_digits)
  {
    return std::isfinite(value) ? with_minus_signs(fmt::format("{:+.{}g}", value + 0., n_digits)) : "not finite";
  }
} // namespace swimtwin
