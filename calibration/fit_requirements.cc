#include <calibration/fit_requirements.h>
#include <datasets/error.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Groups that the model was trained for, the field's scale at 1.
    GroupBox trained_box(const MotionGroups &groups, const CalibrationModel &model)
    {
      const TrainedRange &range = model.range;
      CalibratedSwimmer   low = model.nominal, high = model.nominal;
      low.young_modulus_Pa   = range.young_modulus_Pa.low;
      high.young_modulus_Pa  = range.young_modulus_Pa.high;
      low.magnetization_A_m  = range.magnetization_A_m.low;
      high.magnetization_A_m = range.magnetization_A_m.high;
      low.viscosity_Pa_s     = range.viscosity_Pa_s.high;
      high.viscosity_Pa_s    = range.viscosity_Pa_s.low;
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
    const GroupBox     trained = trained_box(groups, input.model);
    const char        *names[] = {"E/mu (1/s)", "M/mu (A/(m Pa s))"};
    for (Eigen::Index g = 0; g < 2; ++g)
      if (asked.upper[g] < trained.lower[g] || asked.lower[g] > trained.upper[g])
        throw InputError(fmt::format(
            "the bounds exclude every start that the model was trained for: they allow {} from {:.4g} to {:.4g}, and "
            "it knows {:.4g} to {:.4g}; check their units, or set allow_untrained = true in [fit].",
            names[g], std::exp(asked.lower[g]), std::exp(asked.upper[g]), std::exp(trained.lower[g]),
            std::exp(trained.upper[g])));
  }
} // namespace swimtwin
