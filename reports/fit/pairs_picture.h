// How the parameters of a fit scatter together.
#pragma once

#include <datasets/observation/calibration_result.h>
#include <reports/page/gnuplot.h>

namespace swimtwin
{
  /// Whether there are bootstrap estimates of two parameters that the data decide.
  bool has_pairs(const CalibrationResult &result);

  /// Bootstrap estimates of each two such parameters, with the ellipse of the curvature.
  GnuplotPicture pairs_picture(const CalibrationResult &result);
} // namespace swimtwin
