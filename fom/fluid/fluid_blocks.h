// What an iterative solver is told of a fluid with a body in it.
#pragma once

#include <fom/algebra/block_preconditioner.h>
#include <fom/fluid/fluid_domain.h>
#include <fom/unknowns/motion_map.h>

namespace swimtwin
{
  /// Of this rank's unknowns: the fluid's velocities and pressures; all others are the body's.
  template <int dim>
  std::vector<UnknownKind> own_kinds(const FluidDomain<dim> &fluid, const MotionMap<dim> &map);

  /// This rank's contributions to the diagonal of the pressures' mass matrix over the viscosity, at all unknowns.
  template <int dim>
  std::vector<double> pressure_masses(const FluidDomain<dim> &fluid, const MotionMap<dim> &map);
} // namespace swimtwin
