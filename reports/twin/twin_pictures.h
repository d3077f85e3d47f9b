// Pictures of what a twin saw, learned and did.
#pragma once

#include <reports/page/gnuplot.h>
#include <reports/twin/twin_record.h>

namespace swimtwin
{
  /// Parameters with their bands, innovations and trust, the swim and, with a goal, the steering. The record has rows.
  std::vector<GnuplotPicture> twin_pictures(const TwinRecord &record);
} // namespace swimtwin
