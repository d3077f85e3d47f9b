// How far each parameter may be from its estimate: by the misfit's curvature, by its profile, by repeated experiments.
#pragma once

#include <calibration/uncertainty/refit.h>

#include <datasets/observation/calibration_result.h>

namespace swimtwin
{
  /// Half width of an interval of this level in standard deviations: the normal distribution's where the noise is
  /// stated, Student's with n - p degrees of freedom where it was estimated.
  double coverage_factor(double level, bool noise_is_free, int n_degrees_of_freedom);

  /// Value -+ factor standard deviations in the scaled variable, then in the parameter's unit.
  ClaimedInterval curvature_interval(const FitInput &input, const Estimate &estimate, int parameter, double factor);

  /// All values whose least misfit, over all other unknowns, exceeds the minimum by no more than factor^2 / 2.
  struct Profile
  {
    ClaimedInterval  interval;
    ParameterProfile curve;
  };
  Profile profile_of(const FitInput &input, const Estimate &estimate, int parameter, double factor);

  /// Repeated experiments: data are drawn from the estimate, with the noise and the model's error, and fitted again.
  struct Bootstrap
  {
    Eigen::MatrixXd x; ///< n x parameters, scaled
    int             n_failures = 0;
  };
  /// The same for any number of threads.
  Bootstrap       bootstrap(const FitInput &input, const Estimate &estimate, int n_samples, unsigned long seed);
  ClaimedInterval bootstrap_interval(const FitInput &input, const Estimate &estimate, const Bootstrap &samples,
                                     int parameter, double level);

  /// n draws from the curvature, scaled; undecided directions stay.
  Eigen::MatrixXd draws_from_curvature(const Estimate &estimate, int n, unsigned long seed);
} // namespace swimtwin
