#include <rom/sweep/trained_ratios.h>
#include <rom/sweep/trust.h>

#include <datasets/reduced/held_out_error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  std::string TrustNotes::text() const
  {
    std::vector<std::string> all = outside_range;
    all.insert(all.end(), outside_region.begin(), outside_region.end());
    if (!held_out.empty())
      all.push_back(held_out);
    if (!bound.empty())
      all.push_back(bound);
    return fmt::format("{}", fmt::join(all, "; "));
  }

  TrustNotes trust_notes(const TrainedRange &range, const RunRequest &request, const SwimmerRun &run)
  {
    TrustNotes notes;
    notes.outside_range = notes_outside_range(range, request);
    if (notes.outside_range.empty())
      if (notes.outside_range = parameters_outside_range(range, request); !notes.outside_range.empty())
        notes.outside_range.emplace_back("a trained run has the same ratios");
    if (run.largest_shape_radius > 1.)
      notes.outside_region.push_back(
          fmt::format("shape at {:.3g} times the trained region's radius", run.largest_shape_radius));
    if (run.largest_angle_radius > 1.)
      notes.outside_region.push_back(fmt::format("angle at {:.3g} times the trained one", run.largest_angle_radius));
    if (run.largest_height_radius > 1.)
      notes.outside_region.push_back(
          fmt::format("height between the walls at {:.3g} times the trained one", run.largest_height_radius));
    return notes;
  }

  void note_held_out_error(const TrainingRecord &record, const double error, TrustNotes &notes)
  {
    if (std::isnan(error))
      notes.held_out = "no held-out run tells the error";
    else if (error > 2. * target_of(record))
      notes.held_out = fmt::format("held-out runs nearby are off by {:.2g} %", 100. * error);
  }

  void note_error_bound(const TrainingRecord &record, const double bound_m, const double displacement_m,
                        TrustNotes &notes)
  {
    const double relative = bound_m / error_scale_m(record, displacement_m);
    if (relative > largest_borne_error)
      notes.bound = fmt::format("the error may be {:.2g} % (95 %)", 100. * relative);
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
