// Does the estimate move when full-order runs correct the reduced model?
#pragma once

#include <calibration/run/calibrate.h>

namespace swimtwin
{
  /// Runs the full-order model at the estimate for some observations, spread over their frequencies; the ratio of both
  /// displacements, interpolated in log f, corrects all predictions; Gauss and Newton's step with the corrected ones,
  /// without the model's error, is the move. A run that fails ends the check: its verdict says why.
  void check_with_full_order(const FitInput &input, const Estimate &estimate, const CalibrationOptions &options,
                             double factor, ModelDiscrepancy &discrepancy);
} // namespace swimtwin
