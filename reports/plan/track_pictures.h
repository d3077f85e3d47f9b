// Pictures of a swim along a path.
#pragma once

#include <reports/page/gnuplot.h>
#include <reports/plan/track_files.h>

namespace swimtwin
{
  /// The head's way and its mean over the path, and over time: distance, steering and time per decision. At least one
  /// instant.
  std::vector<GnuplotPicture> track_pictures(const TrackRecord &record);
} // namespace swimtwin
