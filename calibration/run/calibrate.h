// A calibration from data to result: fit, intervals, null directions, forecast, check against the full-order model.
#pragma once

#include <calibration/uncertainty/forecast.h>

#include <datasets/observation/calibration_result.h>

namespace swimtwin
{
  struct CalibrationOptions
  {
    int          n_threads     = 0;  ///< 0: as many as the machine has
    int          n_frequencies = 61; ///< of bands
    int          n_checks      = 0;  ///< full-order runs at the optimum
    InertiaTerms inertia       = {}; ///< that all runs carry
    /// Displacement (m) by the full-order model of a swimmer with the scene's geometry, under the condition of one
    /// observation; needed for checks.
    std::function<double(const CalibratedSwimmer &swimmer, const SwimmingCondition &condition)> full_order = {};
    std::function<void(const std::string &what, double done)> on_progress = {}; ///< by any thread, one at a time
  };

  /// Throws InputError for fewer observations than parameters, bounds outside what the model was trained for, bounds
  /// that exclude every start; ComputationError if the fit itself fails.
  CalibrationResult calibrate(const ReducedModel &model, const CalibrationProblem &problem,
                              const std::vector<ObservationSet> &sets, const CalibrationOptions &options = {});

  /// What can be known before a fit: throws InputError as `calibrate` does, else returns what it will warn of.
  std::vector<std::string> check_before_fit(const ReducedModel &model, const CalibrationProblem &problem,
                                            const std::vector<ObservationSet> &sets, const InertiaTerms &inertia = {});
} // namespace swimtwin
