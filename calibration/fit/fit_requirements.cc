#include <calibration/fit/fit_requirements.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Groups that the model knows at the frequencies of the data: E/mu over the frequency is what it was trained for
    /// (rom/sweep/trained_ratios.h). The field's scale is at 1.
    GroupBox known_box(const FitInput &input)
    {
      const TrainedRange &range = input.model.range;
      const double        slow  = input.data.frequency_Hz.minCoeff() / range.frequency_Hz.high,
                   fast         = input.data.frequency_Hz.maxCoeff() / range.frequency_Hz.low;
      CalibratedSwimmer low = input.model.nominal, high = input.model.nominal;
      low.young_modulus_Pa   = range.young_modulus_Pa.low;
      high.young_modulus_Pa  = range.young_modulus_Pa.high;
      low.magnetization_A_m  = range.magnetization_A_m.low;
      high.magnetization_A_m = range.magnetization_A_m.high;
      low.viscosity_Pa_s     = range.viscosity_Pa_s.high / slow;
      high.viscosity_Pa_s    = range.viscosity_Pa_s.low / fast;
      const MotionGroups groups(input.model);
      return {groups.values(low), groups.values(high)};
    }
  } // namespace

  void require_enough_observations(const FitInput &input)
  {
    const int n = input.data.n(), p = static_cast<int>(input.problem.free.size());
    if (n >= p)
      return;
    throw InputError(fmt::format("{} observations cannot fit {} parameters; add observations or fix parameters with "
                                 "value = ... in the problem file.",
                                 n, p));
  }

  void require_overlap_with_trained(const FitInput &input)
  {
    if (input.problem.allow_untrained)
      return;
    const MotionGroups groups(input.model);
    const GroupBox     asked   = input.map.group_box(groups, input.map.lower(), input.map.upper());
    const GroupBox     known   = known_box(input);
    const char        *names[] = {"E/mu (1/s)", "M/mu (A/(m Pa s))"};
    for (Eigen::Index g = 0; g < 2; ++g)
      if (asked.upper[g] < known.lower[g] || asked.lower[g] > known.upper[g])
        throw InputError(fmt::format(
            "the bounds exclude every start that the model was trained for: they allow {} from {:.4g} to {:.4g}, and "
            "at these frequencies it knows {:.4g} to {:.4g}; check their units, or set allow_untrained = true in "
            "[fit].",
            names[g], std::exp(asked.lower[g]), std::exp(asked.upper[g]), std::exp(known.lower[g]),
            std::exp(known.upper[g])));
  }

  void require_fixed_lengths(const FitInput &input)
  {
    const auto is_length = [](const auto &parameter) { return parameter.quantity == FittedQuantity::geometry_scale; };
    if (std::none_of(input.problem.free.begin(), input.problem.free.end(), is_length) &&
        std::none_of(input.problem.given.begin(), input.problem.given.end(), is_length))
      return;
    if (input.reduced.dimension() == 3)
      throw InputError("geometry_scale is not known in three dimensions, where no scene of the fitted swimmer could be "
                       "written; leave it out of the problem.");
    if (input.model.swimmer.has_inertia())
      throw InputError("geometry_scale does not go with inertia, which makes swimmers of different lengths swim "
                       "differently; leave it out of the problem, or leave inertia out with --inertia none.");
  }
} // namespace swimtwin
