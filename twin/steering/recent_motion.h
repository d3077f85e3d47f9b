// The last period of the swimmer as it is known now, and the state that it is in.
#pragma once

#include <control/steering/mean_position.h>
#include <twin/estimate/swimmer_twin.h>

#include <optional>

namespace swimtwin
{
  /// Times in periods of the carrier since an origin.
  struct RecentMotion
  {
    MeanPosition position_m, angle_rad; ///< of the head; the second in the first component
    Belief       now;

    double mean_angle_rad() const { return angle_rad.mean_at(angle_rad.now())[0]; }
  };

  struct PeriodClock
  {
    double origin_s = 0., frequency_Hz = 1.;
    double periods(const double time_s) const { return (time_s - origin_s) * frequency_Hz; }
    double time_s(const double periods) const { return origin_s + periods / frequency_Hz; }
  };

  /// What frames show is smoothed; from the latest of them on the model goes on with what is played, so that the age of
  /// a frame does not matter. Nothing before the first frame, or where the model finds no way on.
  std::optional<RecentMotion> recent_motion(SwimmerTwin &twin, const PeriodClock &clock, double now_s);
} // namespace swimtwin
