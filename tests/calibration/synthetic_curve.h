// A reduced swimmer that is known, and what it would be observed to do.
#pragma once

#include <calibration/run/calibrate.h>

#include <gtest/gtest.h>

#include <memory>

namespace swimtwin
{
  /// The shipped model of the reference box, read once.
  const ReducedModel     &reference_model();
  const CalibrationModel &reference_swimmer();

  /// The scene's swimmer with E = 80 kPa, M = 130 kA/m.
  CalibratedSwimmer known_swimmer();

  /// The third period in the study's field, n frequencies from 0.12 to 2 Hz; displacements as the reduced model has
  /// them for this swimmer, sigma 2 % of each.
  ObservationSet exact_curve(int n, const CalibratedSwimmer &swimmer, std::optional<int> period = 3);
  /// With noise of sigma by the seed.
  ObservationSet noisy_curve(const ObservationSet &exact, unsigned int seed);

  FreeParameter free_parameter(FittedQuantity quantity, double lower, double upper, bool logarithmic = true);
  /// E/mu and M/mu within 30 % of the truth or so, no model error.
  CalibrationProblem two_ratios();

  /// Seven parameters at once, a ratio and the viscosity it refers to among them, two of them with priors.
  CalibrationProblem everything_free();
  /// Unknowns for that problem away from every special value, the model's error among them.
  Eigen::VectorXd somewhere(const ParameterMap &map, int n_components);

  /// Everything that a fit takes, alive as long as this.
  struct Setting
  {
    Setting(CalibrationProblem own_problem, std::vector<ObservationSet> own_sets);
    Setting(const Setting &)            = delete;
    Setting &operator=(const Setting &) = delete;

    CalibrationProblem          problem;
    std::vector<ObservationSet> sets;
    CalibrationData             data;
    ParameterMap                map;
    FitInput                    input;

    /// The known swimmer in scaled variables.
    Eigen::VectorXd truth() const;
    /// A table around it, made once per number of observations and half width (of logarithms).
    std::shared_ptr<DisplacementTable> table(double half_width = 0.25) const;
    Estimate                           estimate() const { return fit_near(input, table(), truth()); }
  };
} // namespace swimtwin
