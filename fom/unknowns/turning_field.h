// A field that turns the head within an implicit step, and whether the step is too long for it.
#pragma once

#include <fom/algebra/linear_system.h>
#include <fom/geometry/rigid_pose.h>
#include <fom/unknowns/motion_map.h>

namespace swimtwin
{
  template <int dim>
  struct TurningField
  {
    dealii::Tensor<2, n_rotations<dim>> torque_by_rate; ///< torque by the head's angular velocity; symmetric
    AngularVelocity<dim>                axis;           ///< about which the field turns the head
  };

  /// Whether an implicit step is too long for an unstable equilibrium. With the torque's derivative by the angular
  /// velocity, a = slope_weight dT/dangle, the head resists by zeta - a: that grows soft where the equilibrium's growth
  /// rate (dT/dangle) / zeta nears 1 / slope_weight, and beyond it turns the head back. Half of this rate is borne.
  /// `system` has been solved with the map's unknowns; its right-hand side is replaced. Collective.
  template <int dim>
  bool outruns_step(const TurningField<dim> &field, const MotionMap<dim> &map, LinearSystem &system);
} // namespace swimtwin
