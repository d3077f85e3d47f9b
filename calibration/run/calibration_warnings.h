// Why a calibration may not be trusted, one sentence each.
#pragma once

#include <calibration/fit/fit.h>

#include <datasets/observation/calibration_result.h>
#include <datasets/observation/observation_set.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// What readers found in the data; sizes that look like another unit, a body of another length; observations outside
  /// what the model was trained for; parameters at their bounds; an observation far from the fit; residuals larger than
  /// the stated sigma explain; a model of unknown error. `result` holds the fit's parameters and residuals.
  std::vector<std::string> calibration_warnings(const FitInput &input, const std::vector<ObservationSet> &sets,
                                                const Estimate &estimate, const CalibrationResult &result);

  /// Those of them that the data and the model tell before a fit.
  std::vector<std::string> data_warnings(const CalibrationModel &model, const std::vector<ObservationSet> &sets);
} // namespace swimtwin
