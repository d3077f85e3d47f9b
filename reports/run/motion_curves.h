// What the pictures of a run show, computed from its trajectory.
#pragma once

#include <datasets/run/work_balance.h>
#include <datasets/scene/scene.h>

#include <span>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Time in periods of the field; in s when the field has no period.
  struct TimeAxis
  {
    double      start_s = 0., unit_s = 1.;
    bool        periodic = false;
    std::string label;

    double operator()(double time_s) const { return (time_s - start_s) / unit_s; }
  };

  TimeAxis time_axis(const Scene &scene, const Trajectory &trajectory);

  using Rows = std::span<const TrajectoryRow>;

  /// 0 when there is no period.
  int n_full_periods(const Trajectory &trajectory, const TimeAxis &axis);

  /// Rows of the last `n_periods` full periods, both ends included; all rows when there are fewer, or no period.
  Rows last_periods(const Trajectory &trajectory, const TimeAxis &axis, int n_periods);

  /// Displacement (m) of the head's centre since the first row along the initial head-first direction.
  double displacement_m(const Trajectory &trajectory, const TrajectoryRow &row);

  /// Area (rad^2) that the path of (head angle, tail angle) encloses, closed by a straight line; positive
  /// counter-clockwise.
  double stroke_loop_area_rad2(Rows rows);

  /// Averages over the interval between two rows, in W/m. The residual is power in - dissipation - outflow - stored
  /// rate; its time integral is the imbalance that the summary reports where that uses the trapezoidal rule too:
  /// everywhere but right after a start under load (docs/equations.md, section 11).
  struct IntervalPower
  {
    double time_s          = 0.; ///< middle of the interval
    double stored_rate_W_m = 0., residual_W_m = 0.;
  };

  std::vector<IntervalPower> interval_powers(Rows rows);

  /// |time average| of the magnetic power; without magnetic work that of the dissipation, as the imbalance is measured.
  double power_scale_W_m(Rows rows);
} // namespace swimtwin
