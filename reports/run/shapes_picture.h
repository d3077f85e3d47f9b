// The swimmer's outline at some instants of the last period.
#pragma once

#include <reports/run/run_picture.h>

namespace swimtwin
{
  /// With a tail it needs snapshots; without one the head alone is drawn, from the trajectory.
  GnuplotPicture shapes_picture(const ShownRun &run);
} // namespace swimtwin
