// Where to start a swimmer at rest so that it soon moves periodically.
#pragma once

#include <control/stroke/stroke.h>

namespace swimtwin
{
  /// The head's angle (rad) of a straight tail from which, after `n_periods`, angle and shape are nearest to the
  /// periodic motion: the heading, which settles slowest, then starts settled. `orbit_start` is a state of that motion
  /// at phase 0. Throws ComputationError if no angle near it leads there.
  double settled_start_angle_rad(const ReducedSwimmer &swimmer, const RunRequest &request,
                                 const SwimmerState &orbit_start, int n_periods);
} // namespace swimtwin
