#include <reports/sweep/frequency_curves.h>

#include <reports/page/number_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace swimtwin
{
  namespace
  {
    /// What tells curves apart, in the order in which they are sorted.
    using Parameters                              = std::array<double, 5>;
    constexpr std::array<const char *, 5> symbols = {"E", "M", "μ", "bx", "by"};
    constexpr std::array<const char *, 5> units   = {"Pa", "A/m", "Pa s", "T", "T"};

    Parameters parameters_of(const SweepPoint &point)
    {
      return {point.young_modulus_Pa, point.magnetization_A_m, point.viscosity_Pa_s, point.bx_T, point.by_T};
    }

    bool differs(const std::vector<SweepPoint> &points, const std::size_t parameter)
    {
      return std::any_of(points.begin(), points.end(), [&](const SweepPoint &point) {
        return parameters_of(point)[parameter] != parameters_of(points.front())[parameter];
      });
    }
  } // namespace

  const CurvePoint &FrequencyCurve::peak() const
  {
    return *std::max_element(points.begin(), points.end(), [](const CurvePoint &a, const CurvePoint &b) {
      return std::abs(a.displacement_m) < std::abs(b.displacement_m);
    });
  }

  bool FrequencyCurve::peaks_at_its_end() const
  {
    return &peak() == &points.front() || &peak() == &points.back();
  }

  bool FrequencyCurve::is_ambiguous() const
  {
    const auto same_frequency = [](const CurvePoint &a, const CurvePoint &b) {
      return a.frequency_Hz == b.frequency_Hz;
    };
    return std::adjacent_find(points.begin(), points.end(), same_frequency) != points.end();
  }

  std::vector<FrequencyCurve> frequency_curves(const std::vector<SweepPoint> &points)
  {
    std::map<Parameters, std::vector<CurvePoint>> groups;
    for (const SweepPoint &point : points)
      groups[parameters_of(point)].push_back({point.frequency_Hz, point.displacement_m});

    std::vector<FrequencyCurve> curves;
    for (auto &[parameters, group] : groups)
    {
      std::string name = fmt::format("E = {} Pa", plain_number(parameters[0], 6));
      for (std::size_t k = 1; k < parameters.size(); ++k)
        if (differs(points, k))
          name += fmt::format(", {} = {} {}", symbols[k], plain_number(parameters[k], 6), units[k]);
      std::sort(group.begin(), group.end());
      curves.push_back({std::move(name), std::move(group)});
    }
    return curves;
  }
} // namespace swimtwin
