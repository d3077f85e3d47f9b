// Pictures of a swim to a target.
#pragma once

#include <reports/page/gnuplot.h>
#include <reports/plan/target_files.h>

namespace swimtwin
{
  /// The head's way to the target, and over time: distance and field. At least one instant.
  std::vector<GnuplotPicture> target_pictures(const TargetRecord &record);
} // namespace swimtwin
