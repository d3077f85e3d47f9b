#include <reports/fit/fitted_quantity.h>

#include <reports/page/number_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace swimtwin
{
  namespace
  {

    struct Symbol
    {
      std::string_view parameter, symbol, unit;
    };
    constexpr std::array<Symbol, 10> symbols{{{"young_modulus_over_viscosity_1_s", "E/μ", "1/s"},
                                              {"magnetization_over_viscosity_A_m_Pa_s", "M/μ", "A/(m Pa s)"},
                                              {"young_modulus_Pa", "E", "Pa"},
                                              {"viscosity_Pa_s", "μ", "Pa s"},
                                              {"magnetization_A_m", "M", "A/m"},
                                              {"field_scale", "field scale", ""},
                                              {"geometry_scale", "geometry scale", ""},
                                              {"displacement_scale", "displacement scale", ""},
                                              {"displacement_offset_m", "displacement offset", "m"},
                                              {"noise_scale", "noise scale", ""}}};

    struct Prefix
    {
      int              exponent;
      std::string_view letter, power;
    };
    constexpr std::array<Prefix, 7> prefixes{{{-9, "n", "10⁻⁹"},
                                              {-6, "μ", "10⁻⁶"},
                                              {-3, "m", "10⁻³"},
                                              {0, "", ""},
                                              {3, "k", "10³"},
                                              {6, "M", "10⁶"},
                                              {9, "G", "10⁹"}}};

    const Prefix &prefix_for(const double value)
    {
      const double size     = std::isfinite(value) && value != 0. ? std::log10(std::abs(value)) : 0.;
      const int    exponent = 3 * static_cast<int>(std::floor(size / 3. + 1e-9));
      const auto   found    = std::find_if(prefixes.begin(), prefixes.end(),
                                           [&](const Prefix &prefix) { return prefix.exponent >= exponent; });
      return found == prefixes.end() ? prefixes.back() : *found;
    }

    std::string prefixed(const Prefix &prefix, const std::string_view unit)
    {
      if (unit.starts_with("1/"))
        return prefix.exponent == 0 ? std::string(unit) : fmt::format("{}{}", prefix.power, unit.substr(1));
      return fmt::format("{}{}", prefix.letter, unit);
    }
  } // namespace

  std::string ShownQuantity::label() const
  {
    return unit.empty() ? symbol : fmt::format("{} ({})", symbol, unit);
  }

  ShownQuantity shown_quantity(const std::string &parameter, const double value)
  {
    const auto found = std::find_if(symbols.begin(), symbols.end(),
                                    [&](const Symbol &symbol) { return symbol.parameter == parameter; });
    if (found == symbols.end())
      return {parameter, "", 1.};
    if (found->unit.empty())
      return {std::string(found->symbol), "", 1.};
    const Prefix &prefix = prefix_for(value);
    return {std::string(found->symbol), prefixed(prefix, found->unit), std::pow(10., -prefix.exponent)};
  }

  std::string level_text(const double level)
  {
    return fmt::format("{} %", plain_number(100. * level, 3));
  }

  std::string interval_text(const ClaimedInterval &interval, const ShownQuantity &shown)
  {
    const auto number = [&](const double value) { return plain_number(shown.factor * value, result_digits); };
    if (interval.is_finite())
      return fmt::format("{} to {}", number(*interval.low), number(*interval.high));
    if (interval.low)
      return fmt::format("above {}", number(*interval.low));
    if (interval.high)
      return fmt::format("below {}", number(*interval.high));
    return interval.method.empty() ? "not computed" : "not bounded";
  }
} // namespace swimtwin
