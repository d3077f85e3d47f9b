// How the parameters of a fit scatter together.
#pragma once

#include <app/gnuplot.h>
#include <datasets/calibration_result.h>

namespace swimtwin
{
  /// Bootstrap estimates of each two free parameters, with the ellipse of the curvature; needs two samples.
  GnuplotPicture pairs_picture(const CalibrationResult &result);
} // namespace swimtwin
