// Pictures of a plan: fields over a period, hodograph, head paths, speeds, trade-off, searches.
#pragma once

#include <reports/page/gnuplot.h>
#include <reports/plan/plan_files.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Those for which the plan has data.
  std::vector<GnuplotPicture> plan_pictures(const PlanFolder &folder);
} // namespace swimtwin
