// What counts as a change of state.
#pragma once

#include <rom/swimmer/reduced_swimmer.h>

namespace swimtwin
{
  /// Of a swimmer's shape and of its path in a period, in body lengths.
  inline constexpr double stroke_per_length = 0.03;

  /// One per component of the state: a stroke (m) for lengths, a radian for the angle.
  inline Eigen::VectorXd state_scale(const ReducedSwimmer &swimmer)
  {
    Eigen::VectorXd scale = Eigen::VectorXd::Constant(swimmer.n_states(), stroke_per_length * swimmer.length_m());
    scale[2]              = 1.;
    if (swimmer.has_inertia())
      scale[2 + swimmer.n_velocities()] = 1.; // rad/s: velocities count as if they lasted for a second
    return scale;
  }
} // namespace swimtwin
