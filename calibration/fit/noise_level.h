// How much larger the scatter of the data is than their stated sigma.
#pragma once

#include <calibration/misfit/misfit.h>

namespace swimtwin
{
  /// The problem's free noise_scale; null if the stated sigma are to be believed.
  const FreeParameter *free_noise_scale(const CalibrationProblem &problem);

  /// The standard deviation of the scatter over the stated sigma, by restricted maximum likelihood (for least squares
  /// without model error: the residuals' sum of squares over the degrees of freedom); with a robust loss by the median
  /// of the residuals. Within the bounds.
  double noise_scale_estimate(const Misfit &misfit, const Eigen::VectorXd &unknowns, const Prediction &prediction,
                              double lower, double upper);
} // namespace swimtwin
