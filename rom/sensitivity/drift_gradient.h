// The drift of a periodic motion and its derivative by everything, through the transposed monodromy.
#pragma once

#include <rom/sensitivity/adjoint_integrator.h>
#include <rom/sensitivity/periodic_orbit.h>

namespace swimtwin
{
  /// direction . drift (m per period) of a converged orbit and its derivatives along the family of periodic motions;
  /// those by the initial state are zero. The price is a run with the sensitivities to angle and shape, and one
  /// adjoint, however many parameters the field has. A failure is a status of the result.
  MotionGradient differentiate_drift(const ReducedSwimmer &swimmer, const RunRequest &request,
                                     const PeriodicOrbit &orbit, const Eigen::Vector2d &direction,
                                     const AdjointOptions &options = {});
} // namespace swimtwin
