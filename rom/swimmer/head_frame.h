// Vectors in the head's frame and in the laboratory.
#pragma once

#include <Eigen/Dense>

#include <cmath>

namespace swimtwin
{
  inline Eigen::Vector2d in_head_frame(const double angle, const Eigen::Vector2d &v)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x() + s * v.y(), -s * v.x() + c * v.y()};
  }

  /// Unit vector along which a swimmer of this heading has positive displacements: head first.
  inline Eigen::Vector2d head_first(const double heading_rad)
  {
    return {-std::cos(heading_rad), -std::sin(heading_rad)};
  }

  inline double cross(const Eigen::Vector2d &a, const Eigen::Vector2d &b)
  {
    return a.x() * b.y() - a.y() * b.x();
  }

  /// Head-frame velocities become rates of the state, in place.
  template <typename Columns>
  void turn_to_laboratory(const double angle, Columns &&velocities)
  {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
    velocities.topRows(2)   = (R * velocities.topRows(2)).eval();
  }
} // namespace swimtwin
