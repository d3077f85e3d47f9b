// Resistance of any set of motions of the body: P^T A P with the columns of a reduced swimmer.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>

#include <deal.II/lac/full_matrix.h>

namespace swimtwin
{
  template <int dim>
  struct MotionResistance
  {
    /// Generalised force of the body on the fluid per generalised velocity of a motion in the plane of x and y, in the
    /// order R^T U, omega (about the head's centre), then the modes; SI, per unit depth in 2D.
    dealii::FullMatrix<double> matrix;
    double                     asymmetry = 0.; ///< largest |R_ij - R_ji| / sqrt(R_ii R_jj), before it was averaged away
  };

  /// Solve one Stokes problem for each motion, with one factorisation, on the fluid's mesh as it is; forces are the
  /// reaction of the weak form. `modes` are fields on the tail's nodes in the head's frame. In a domain closed by walls
  /// the change of the body's area that a motion brings is taken up evenly by the fluid; only motions that keep the
  /// area are then physical. Collective; throws ComputationError.
  template <int dim>
  MotionResistance<dim> compute_motion_resistance(const Swimmer<dim> &swimmer, const FluidDomain<dim> &fluid,
                                                  const Configuration<dim>           &configuration,
                                                  const std::vector<NodalField<dim>> &modes);

  /// The same on a mesh made for this configuration. Collective.
  template <int dim>
  MotionResistance<dim> compute_motion_resistance(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                                  const std::vector<NodalField<dim>> &modes, MPI_Comm communicator);

  /// The flow around a body that moves at these rates, on the fluid's mesh as it is: values of the fluid's rows
  /// (velocities, scaled pressures; those of a closed domain with any level). Collective; throws ComputationError.
  template <int dim>
  std::vector<double> compute_flow(const Swimmer<dim> &swimmer, const FluidDomain<dim> &fluid,
                                   const Configuration<dim> &configuration, const Rates<dim> &rates);
} // namespace swimtwin
