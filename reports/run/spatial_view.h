// The swimmer in space over a period, seen from above its plane of motion.
#pragma once

#include <reports/run/run_picture.h>

namespace swimtwin
{
  /// Of a run in three dimensions, with its snapshots where it has a tail.
  GnuplotPicture spatial_view_picture(const ShownRun &run);
} // namespace swimtwin
