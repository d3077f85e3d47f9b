#include <control/field/steering_limits.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int    n_phases = 1000; // what lies between two of them is larger by at most 5e-6 of it
    constexpr double between  = 1. + 5e-6;

    double phase(const int i)
    {
      return static_cast<double>(i) / n_phases;
    }

    double largest_magnitude_T(const Drive &carrier)
    {
      double largest = 0.;
      for (int i = 0; i < n_phases; ++i)
        largest = std::max(largest, carrier.field->value_T(phase(i), carrier.parameters).norm());
      return largest;
    }

    Eigen::Vector2d rate_T(const Drive &carrier, const double at)
    {
      constexpr double h = 1e-4; // error of the difference: (2 pi h)^2 / 6 = 7e-8 of the rate
      return (carrier.field->value_T(at + h, carrier.parameters) - carrier.field->value_T(at - h, carrier.parameters)) /
             (2. * h);
    }
  } // namespace

  double largest_slew_T_per_period(const Drive &carrier, const double turn_rate)
  {
    double largest = 0.;
    for (int i = 0; i < n_phases; ++i)
    {
      const Eigen::Vector2d c = carrier.field->value_T(phase(i), carrier.parameters), rate = rate_T(carrier, phase(i));
      const Eigen::Vector2d turning = turn_rate * Eigen::Vector2d(-c.y(), c.x());
      largest                       = std::max({largest, (rate + turning).norm(), (rate - turning).norm()});
    }
    return between * largest;
  }

  double largest_turn_rate(const Drive &carrier, const double slew_rate_T_s, const double fastest)
  {
    const auto is_kept = [&](const double rate) {
      return largest_slew_T_per_period(carrier, rate) * carrier.frequency_Hz <= slew_rate_T_s;
    };
    if (is_kept(fastest))
      return fastest;
    if (!is_kept(0.))
      return -1.;
    double low = 0., high = fastest;
    for (int i = 0; i < 40; ++i)
      (is_kept(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return low;
  }

  std::optional<BrokenLimit> limit_broken_when_turned(const Drive &carrier, const FieldLimits &limits)
  {
    const double largest  = largest_magnitude_T(carrier);
    const double rounding = 1. + 1e-9;
    const auto   broken   = [&](const char *key, const double bound) -> std::optional<BrokenLimit> {
      if (largest <= bound * rounding)
        return {};
      return BrokenLimit{key, fmt::format("is below the carrier's largest field of {:.4g} T, which is turned to every "
                                                  "direction; weaken [carrier] bx_T or by_T.",
                                              largest)};
    };
    for (const auto &found : {broken("magnitude_T", limits.magnitude_T), broken("bx_T", limits.component_T[0]),
                              broken("by_T", limits.component_T[1])})
      if (found)
        return found;
    for (Eigen::Index i = 0; i < limits.current_per_field_A_T.rows(); ++i)
      if (const double current = limits.current_per_field_A_T.row(i).norm() * largest;
          current > limits.current_A * rounding)
        return BrokenLimit{"coil_current_A",
                           fmt::format("is below the {:.4g} A that coil {} needs where the carrier points along it; "
                                       "weaken [carrier] bx_T or by_T.",
                                       current, i + 1)};
    return {};
  }
} // namespace swimtwin
