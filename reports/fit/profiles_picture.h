// How fast the misfit grows along each parameter of a fit.
#pragma once

#include <datasets/observation/calibration_result.h>
#include <reports/page/gnuplot.h>

namespace swimtwin
{
  /// Misfit along each parameter with all others fitted, and its interval; needs profiles.
  GnuplotPicture profiles_picture(const CalibrationResult &result);
} // namespace swimtwin
