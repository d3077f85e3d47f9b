// A shape that is given over time moves the head: how far, and which way.
#pragma once

#include <rom/swimmer/reduced_swimmer.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// A shape as a function of phase.
  class Gait
  {
  public:
    virtual ~Gait() = default;

    virtual ShapeVector shape_m(double phase) const = 0;
    virtual ShapeVector rate_m(double phase) const  = 0; ///< its derivative by phase
  };

  struct GaitRun
  {
    bool                         completed = false;
    std::string                  failure;       ///< one sentence
    std::vector<Eigen::Vector3d> at_period_end; ///< x, y (m), angle (rad); the initial pose first
  };

  /// The head's pose, without force or torque, while the swimmer goes through the gait from the pose (0, 0, angle_rad).
  /// Neither viscosity nor the speed at which the gait is gone through matters. CVODES, Adams' method.
  GaitRun follow_gait(const ReducedSwimmer &swimmer, const Gait &gait, double angle_rad, int n_periods,
                      double relative_tolerance = 1e-8);
} // namespace swimtwin
