// The flow around the swimmer in its plane of motion.
#pragma once

#include <reports/run/run_picture.h>

namespace swimtwin
{
  /// Whether there is a flow to show: one that moves.
  bool has_flow(const ShownRun &run);

  /// Speed as colour, direction as arrows, and the outline of the swimmer, at the instants that the run kept.
  GnuplotPicture flow_picture(const ShownRun &run);
} // namespace swimtwin
