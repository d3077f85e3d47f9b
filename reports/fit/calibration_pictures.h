// Pictures of a fit.
#pragma once

#include <datasets/observation/calibration_result.h>
#include <reports/page/gnuplot.h>

#include <vector>

namespace swimtwin
{
  /// Data, curve and bands against frequency, residuals below; needs residuals.
  GnuplotPicture fit_picture(const CalibrationResult &result);
  /// What one more observation would do; needs `next`.
  GnuplotPicture next_experiment_picture(const CalibrationResult &result);

  /// Those that the result has numbers for: fit, profiles, pairs, waterfall, next_experiment.
  std::vector<GnuplotPicture> calibration_pictures(const CalibrationResult &result);
} // namespace swimtwin
