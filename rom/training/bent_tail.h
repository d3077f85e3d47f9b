// Shapes and elastic energy of a tail against its bending coordinates: polynomials through shapes of least energy.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/coordinate_polynomials.h>
#include <rom/training/bending_coordinates.h>
#include <rom/training/tail_basis.h>

#include <mpi.h>

#include <functional>

namespace swimtwin
{
  struct BentTail
  {
    BendingCoordinates    coordinates;
    Eigen::MatrixXd       modes;  ///< dim n_nodes x R, orthonormal in the mean over the tail
    Eigen::VectorXi       parity; ///< of the modes under the mirror
    ShapePolynomials      amplitudes, energy;
    CoordinatePolynomials polynomials;       ///< the amplitudes, to be evaluated
    int                   n_shapes     = 0;  ///< that they are fitted to
    double                shape_error  = 0.; ///< root mean square misfit of the shapes, relative
    double                moment_error = 0.; ///< of the energy's derivatives, relative
  };

  /// `seen`: coordinates that runs went through, one column each; shapes are relaxed there, a fifth beyond, and in the
  /// ball around. `displacements`: those of the runs, in the same order, for what their loads do beside bending; none
  /// leaves that out. Collective. Throws ComputationError if too few shapes can be relaxed.
  template <int dim>
  BentTail fit_bent_tail(const Swimmer<dim> &swimmer, const TailSpace &space, const BendingCoordinates &coordinates,
                         const Eigen::MatrixXd &seen, const Eigen::MatrixXd &displacements, MPI_Comm communicator,
                         const std::function<void(int, int)> &on_progress = {});

  /// What a bent basis leaves of displacements (one per column): root mean square over them and the tail, m.
  double left_by(const TailBasis &basis, const Eigen::MatrixXd &displacements, const TailSpace &space);
  /// The same of those that it was made from, noted in the basis.
  void record_representation(const Eigen::MatrixXd &displacements, const TailSpace &space, TailBasis &basis);
} // namespace swimtwin
