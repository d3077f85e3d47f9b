// How fast the misfit grows along each parameter of a fit.
#pragma once

#include <app/gnuplot.h>
#include <datasets/calibration_result.h>

namespace swimtwin
{
  /// Misfit along each parameter with all others fitted, and its interval; needs profiles.
  GnuplotPicture profiles_picture(const CalibrationResult &result);
} // namespace swimtwin
