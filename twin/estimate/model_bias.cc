#include <datasets/system/error.h>
#include <rom/sensitivity/periodic_orbit.h>
#include <twin/estimate/model_bias.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    SwimmerParameters changed(SwimmerParameters parameters, const double stiffness_log, const double magnetization_log)
    {
      parameters.young_modulus_Pa *= std::exp(stiffness_log);
      parameters.magnetization_A_m *= std::exp(magnetization_log);
      return parameters;
    }
  } // namespace

  PeriodicMotion periodic_motion(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Drive &drive)
  {
    RunRequest          request{parameters, drive, state_at_rest(swimmer), 1, 0};
    const PeriodicOrbit orbit = PeriodicOrbitFinder(swimmer).find(request);
    if (!orbit.converged())
      throw ComputationError(fmt::format("the field gives no periodic motion: {}", orbit.failure));
    request.initial_state      = orbit.start;
    request.samples_per_period = 64;
    const SwimmerRun run       = SwimmerIntegrator(swimmer, {}).run(request);
    if (!run.completed())
      throw ComputationError(fmt::format("the field gives no periodic motion: {}", run.failure));
    // Of a periodic function the mean over equal steps is accurate as no other rule is: n + 1 rows, the last one the
    // first again.
    const auto     n = static_cast<Eigen::Index>(run.snapshots.size()) - 1;
    Eigen::ArrayXd angle_rad(n);
    for (Eigen::Index i = 0; i < n; ++i)
      angle_rad[i] = run.snapshots[static_cast<std::size_t>(i)].state[2];
    return {orbit.drift_m.norm(), std::sqrt(2. * (angle_rad - angle_rad.mean()).square().mean())};
  }

  Eigen::Matrix2d ratio_bias(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Drive &drive,
                             const double relative_error, const Eigen::Vector2d &first_sd)
  {
    if (relative_error == 0.)
      return Eigen::Matrix2d::Zero();
    constexpr double small = 0.01;
    Eigen::Matrix2d  sensitivity;
    for (int i = 0; i < 2; ++i)
    {
      const auto           at   = [&](const double d) { return changed(parameters, i == 0 ? d : 0., i == 1 ? d : 0.); };
      const PeriodicMotion more = periodic_motion(swimmer, at(small), drive),
                           less = periodic_motion(swimmer, at(-small), drive);
      sensitivity.col(i) << std::log(more.displacement_m / less.displacement_m),
          std::log(more.swing_rad / less.swing_rad);
    }
    sensitivity /= 2. * small;
    // Columns in units of the first deviations: what is fixed has none.
    const Eigen::Matrix2d scaled    = sensitivity * first_sd.asDiagonal() / relative_error,
                          precision = Eigen::Matrix2d::Identity() + scaled.transpose() * scaled;
    return first_sd.asDiagonal() * precision.inverse() * first_sd.asDiagonal();
  }
} // namespace swimtwin
