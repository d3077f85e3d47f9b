#include <reports/page/number_text.h>

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

  std::string duration_text(const double seconds)
  {
    const long s = std::lround(seconds);
    if (s < 60)
      return fmt::format("{} s", s);
    if (s < 3600)
      return fmt::format("{} min {} s", s / 60, s % 60);
    return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
  }
} // namespace swimtwin
