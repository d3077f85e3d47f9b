// Small vectors and matrices that live on the stack: their sizes follow from the number of modes.
#pragma once

#include <Eigen/Dense>

namespace swimtwin
{
  constexpr int max_modes      = 16;
  constexpr int max_velocities = max_modes + 3;

  using ShapeVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_modes, 1>; ///< r
  using ShapeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_modes, max_modes>;
  /// r + 3; with inertia velocities are part of the state, and rates of the state twice as long.
  using VelocityVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * max_velocities, 1>;
  using VelocityMatrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_velocities, max_velocities>;

  /// Amplitudes of the modes: the coordinates', then the followers'.
  constexpr int max_amplitudes = 32;
  using AmplitudeVector        = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_amplitudes, 1>;
  using AmplitudeMatrix        = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_amplitudes,
                                        max_modes>; ///< (r + s) x r

  /// (x, y, theta, q_1 .. q_r): head's centre (m), head's angle (rad), shape (m). With inertia the velocities
  /// (R^T dx/dt, omega, dq/dt) follow.
  using SwimmerState = VelocityVector;
} // namespace swimtwin
