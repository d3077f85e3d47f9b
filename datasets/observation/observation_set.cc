#include <datasets/observation/observation_set.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double most_body_lengths = 3., smallest_m = 1e-9;

    FieldProgram stretched(const FieldProgram &field, const double period_s)
    {
      std::vector<double> time_s = field.time_s();
      for (double &time : time_s)
        time *= period_s / field.period_s();
      return FieldProgram::sampled(std::move(time_s), field.b_T(), period_s);
    }
  } // namespace

  FieldProgram field_at(const ObservationSet &set, const double frequency_Hz)
  {
    if (!std::isfinite(frequency_Hz) || frequency_Hz <= 0.)
      throw InputError(fmt::format("frequency_Hz = {} of an observation must be positive.", frequency_Hz));
    if (set.field.waveform() == FieldProgram::Waveform::sampled)
      return stretched(set.field, 1. / frequency_Hz);
    return FieldProgram::sinusoidal(set.field.bx_T(), set.field.by_T(), frequency_Hz);
  }

  std::vector<std::string> implausible_sizes(const ObservationSet &set, const double body_length_m)
  {
    if (set.points.empty())
      return {};
    const auto farthest =
        std::max_element(set.points.begin(), set.points.end(), [](const Observation &a, const Observation &b) {
          return std::abs(a.displacement_m) < std::abs(b.displacement_m);
        });
    const double size = std::abs(farthest->displacement_m);
    if (size > most_body_lengths * body_length_m)
      return {fmt::format("{}: a displacement of {:.4g} m per period is {:.3g} body lengths of {:.3g} m; it looks like "
                          "mm in a column of metres: check the unit.",
                          farthest->where, size, size / body_length_m, body_length_m)};
    if (size < smallest_m)
      return {fmt::format("{}: no displacement is larger than {:.4g} m per period, less than a camera sees; check the "
                          "unit.",
                          farthest->where, size)};
    return {};
  }
} // namespace swimtwin
