// The starts of a fit: where each began and where it ended.
#pragma once

#include <datasets/observation/calibration_result.h>
#include <reports/page/gnuplot.h>

namespace swimtwin
{
  /// Misfits of the starts, best first; needs starts.
  GnuplotPicture waterfall_picture(const CalibrationResult &result);
} // namespace swimtwin
