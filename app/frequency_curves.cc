#include <app/frequency_curves.h>
#include <app/number_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace swimtwin
{
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
    const bool one_magnetization = std::all_of(points.begin(), points.end(), [&](const SweepPoint &point) {
      return point.magnetization_A_m == points.front().magnetization_A_m;
    });
    std::map<std::pair<double, double>, std::vector<CurvePoint>> groups;
    for (const SweepPoint &point : points)
      groups[{point.young_modulus_Pa, point.magnetization_A_m}].push_back({point.frequency_Hz, point.displacement_m});

    std::vector<FrequencyCurve> curves;
    for (auto &[parameters, group] : groups)
    {
      std::string name = fmt::format("E = {} Pa", plain_number(parameters.first, 6));
      if (!one_magnetization)
        name += fmt::format(", M = {} A/m", plain_number(parameters.second, 6));
      std::sort(group.begin(), group.end());
      curves.push_back({std::move(name), std::move(group)});
    }
    return curves;
  }
} // namespace swimtwin
