// The fluid's past on a new mesh.
#pragma once

#include <fom/fluid/fluid_domain.h>

namespace swimtwin
{
  /// Velocities are interpolated, and so is the old mesh's motion, which the new mesh takes over; at the swimmer's
  /// surface, whose nodes are the same, nothing changes. Then what interpolation does to the divergence is taken off:
  /// of all flows without divergence the one nearest in the mean square is kept, or the pressure of the next step would
  /// answer a jump of volume. The new mesh must be where the old one is. Collective; throws ComputationError if a node
  /// lies outside the old mesh.
  template <int dim>
  FluidPast<dim> transfer_past(const FluidDomain<dim> &from, const FluidDomain<dim> &to);

  /// The flow nearest to `motion` in the mean square that has no divergence (against the linear pressures) at its
  /// positions, with the same values at the swimmer and at walls. Collective.
  template <int dim>
  void remove_divergence(const FluidDomain<dim> &fluid, FluidMotion<dim> &motion);
} // namespace swimtwin
