// How much points on the body's axis swing while the head's mean position is led along a path.
#pragma once

#include <control/steering/mean_position.h>
#include <control/steering/path.h>
#include <control/steering/plant.h>

#include <vector>

namespace swimtwin
{
  struct PoseInstant
  {
    double periods = 0.; ///< of the carrier
    Pose   pose;
    double arc_m = 0.; ///< where on the path the head's mean position is
  };

  /// A point fixed in the head's frame, on its axis. Root mean squares over time, of instantaneous distances.
  struct AxisPoint
  {
    double behind_m       = 0.; ///< the head's centre, towards the tail
    double rms_distance_m = 0.; ///< from the path, which is the head's: a point behind cuts its curves
    double rms_swing_m    = 0.; ///< from its own mean over the period around the instant
  };

  /// From the head's centre to a body length behind it, in steps of a twentieth. Instants at least ten times per
  /// period, in order; those nearer than half a period to an end give means only. Empty for less than two periods.
  std::vector<AxisPoint> swing_along_axis(const std::vector<PoseInstant> &instants, const Path &path, double length_m);

  /// The one that swings least, between those given too: squares of distances are quadratic along the axis. Of at least
  /// three points, equally spaced.
  AxisPoint least_swinging(const std::vector<AxisPoint> &points);
} // namespace swimtwin
