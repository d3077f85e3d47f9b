#include <rom/trust.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double round_off = 1e-7;

    void compare(const char *name, const double value, const Interval &range, std::vector<std::string> &notes)
    {
      const double slack = round_off * std::max(std::abs(range.low), std::abs(range.high));
      if (value < range.low - slack)
        notes.push_back(fmt::format("{} = {:.4g} below {:.4g}", name, value, range.low));
      if (value > range.high + slack)
        notes.push_back(fmt::format("{} = {:.4g} above {:.4g}", name, value, range.high));
    }
  } // namespace

  std::string TrustNotes::text() const
  {
    std::vector<std::string> all = outside_range;
    all.insert(all.end(), outside_region.begin(), outside_region.end());
    return fmt::format("{}", fmt::join(all, "; "));
  }

  TrustNotes trust_notes(const TrainedRange &range, const RunRequest &request, const SwimmerRun &run)
  {
    TrustNotes  notes;
    const auto &p = request.parameters;
    compare("young_modulus_Pa", p.young_modulus_Pa, range.young_modulus_Pa, notes.outside_range);
    compare("viscosity_Pa_s", p.viscosity_Pa_s, range.viscosity_Pa_s, notes.outside_range);
    compare("magnetization_A_m", p.magnetization_A_m, range.magnetization_A_m, notes.outside_range);
    compare("frequency_Hz", request.drive.frequency_Hz, range.frequency_Hz, notes.outside_range);
    if (dynamic_cast<const SinusoidalField *>(request.drive.field.get()) != nullptr)
    {
      compare("bx_T", request.drive.parameters[0], range.bx_T, notes.outside_range);
      compare("by_T", request.drive.parameters[1], range.by_T, notes.outside_range);
    }
    if (run.largest_shape_radius > 1.)
      notes.outside_region.push_back(
          fmt::format("shape at {:.3g} times the trained region's radius", run.largest_shape_radius));
    if (run.largest_angle_radius > 1.)
      notes.outside_region.push_back(fmt::format("angle at {:.3g} times the trained one", run.largest_angle_radius));
    return notes;
  }

  double displacement_error_indicator(const double all_modes_m, const double fewer_modes_m)
  {
    return std::abs(all_modes_m - fewer_modes_m);
  }

  int n_modes_of_comparison(const int n_modes)
  {
    return std::min(n_modes, std::max(1, n_modes - 2));
  }
} // namespace swimtwin
