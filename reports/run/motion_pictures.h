// The pictures that are made from a run's trajectory alone.
#pragma once

#include <reports/run/run_picture.h>

namespace swimtwin
{
  /// Path of the head's centre and its displacement head first. For a head that moves.
  GnuplotPicture trajectory_picture(const ShownRun &run);

  /// Angles of head and tail over time, above the field. For a head that moves, or a tail.
  GnuplotPicture angles_picture(const ShownRun &run);

  /// Tail against head angle, with the area enclosed in the last period. For a head that moves, a tail, a full period.
  GnuplotPicture stroke_loop_picture(const ShownRun &run);

  /// Magnetic power, dissipation and rate of stored energy over the last periods, above their residual.
  GnuplotPicture power_balance_picture(const ShownRun &run);

  /// Whether any power or elastic energy was recorded.
  bool has_power(const Trajectory &trajectory);
} // namespace swimtwin
