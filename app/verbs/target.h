// Goals of the kind "target": swim to a place, with files and pictures.
#pragma once

#include <app/verbs/track.h>

namespace swimtwin
{
  /// Throws InputError, also for a target that no field within the limits reaches (its files say "infeasible"), and
  /// ComputationError.
  void reach_and_report(const TrackCommand &command);
} // namespace swimtwin
