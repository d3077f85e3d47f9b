// What counts as a change of state.
#pragma once

#include <rom/swimmer/reduced_swimmer.h>

namespace swimtwin
{
  /// Of a swimmer's shape and of its path in a period, in body lengths.
  inline constexpr double stroke_per_length = 0.03;

  /// Of a velocity beside what changes the state by its scale in a period: velocities follow the forces within a small
  /// part of one, and what they are off by does not last.
  inline constexpr double looser_velocity = 100.;

  /// One per component of the state: a stroke (m) for lengths, a radian for the angle; of velocities those in a period,
  /// less sharply.
  inline Eigen::VectorXd state_scale(const ReducedSwimmer &swimmer, const double frequency_Hz = 1.)
  {
    Eigen::VectorXd scale = Eigen::VectorXd::Constant(swimmer.n_states(), stroke_per_length * swimmer.length_m());
    scale[2]              = 1.;
    if (swimmer.has_inertia())
    {
      scale[2 + swimmer.n_velocities()] = 1.;
      scale.tail(swimmer.n_velocities()) *= looser_velocity * frequency_Hz;
    }
    return scale;
  }
} // namespace swimtwin
