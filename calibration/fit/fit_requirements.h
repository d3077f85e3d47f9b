// What must hold before a fit is worth its time. Each throws InputError with what to change.
#pragma once

#include <calibration/fit/fit_input.h>

namespace swimtwin
{
  void require_enough_observations(const FitInput &input);
  /// Bounds that hold nothing that the model knows are most likely in another unit; refused unless the problem says
  /// allow_untrained.
  void require_overlap_with_trained(const FitInput &input);
  /// Inertia knows lengths: swimmers of another size do not swim alike.
  void require_fixed_lengths(const FitInput &input);
} // namespace swimtwin
