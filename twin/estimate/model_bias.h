// What a reduced model's own error does to the parameters, however long one watches.
#pragma once

#include <rom/swimmer/reduced_swimmer.h>
#include <rom/swimmer/swimmer_parameters.h>

namespace swimtwin
{
  /// Motion of a period in a field: what a camera sees again and again.
  struct PeriodicMotion
  {
    double displacement_m = 0., swing_rad = 0.; ///< of the head; root of twice the variance of its angle
  };
  /// Throws ComputationError where there is no periodic motion.
  PeriodicMotion periodic_motion(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters,
                                 const Drive &drive);

  /// Covariance of log(E/mu) and log(M/mu), 2 x 2, which is left when displacement and swing are both off by
  /// `relative_error` (a standard deviation, independent of each other) in every period alike, so that no average
  /// helps: (P^-1 + S^T S / relative_error^2)^-1, with S the derivatives of log(displacement) and log(swing), and P the
  /// square of the parameters' first deviations (0: fixed). Zero without an error. Throws ComputationError as above.
  Eigen::Matrix2d ratio_bias(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Drive &drive,
                             double relative_error, const Eigen::Vector2d &first_sd);
} // namespace swimtwin
