// Hydrodynamic resistance of a body that moves as if it were rigid: P^T A P with the thinnest P.
#pragma once

#include <fom/body/swimmer.h>

#include <deal.II/lac/full_matrix.h>

namespace swimtwin
{
  template <int dim>
  struct ResistanceResult
  {
    /// Force and torque (about the head's centre) of the body on the fluid per velocity and angular velocity; order Ux,
    /// Uy, omega; in 3D Ux, Uy, Uz and omega about x, y, z, or where half of the scene is solved Ux, Uy and omega about
    /// z, the motions in its plane; SI, per unit depth in 2D (Pa s, Pa s m, Pa s m^2).
    dealii::FullMatrix<double> matrix;
    double                     asymmetry  = 0.; ///< largest |R_ij - R_ji| / sqrt(R_ii R_jj)
    unsigned int               n_unknowns = 0, n_cells = 0;
  };

  /// Meshes the fluid around the given configuration and solves for each motion with one factorisation. The rigid
  /// velocities are the unknowns and unit forces the data, so the mobility comes out of the same symmetric algebra as
  /// the swimmer's step; its inverse is the resistance. Collective; throws ComputationError.
  template <int dim>
  ResistanceResult<dim> compute_resistance(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                           MPI_Comm communicator);
} // namespace swimtwin
