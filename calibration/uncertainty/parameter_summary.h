// Every quantity of the calibrated swimmer with what is known of it.
#pragma once

#include <calibration/uncertainty/intervals.h>

namespace swimtwin
{
  /// Free parameters first, with intervals by curvature; then what follows from them; then what was given.
  std::vector<CalibratedParameter> summarize_parameters(const FitInput &input, const Estimate &estimate, double factor);
} // namespace swimtwin
