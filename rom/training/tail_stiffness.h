// What the elastic tail does by itself: its bending modes, and the shortening that bending costs.
#pragma once

#include <fom/body/swimmer.h>
#include <rom/training/tail_basis.h>

#include <Eigen/SparseCholesky>

namespace swimtwin
{
  /// Stiffness of the clamped tail. Clamped components have unit rows.
  class TailStiffness
  {
  public:
    /// Both must outlive this. Throws ComputationError.
    TailStiffness(const Swimmer<2> &swimmer, const TailSpace &space);

    /// The lowest n bending modes, K phi = omega^2 M phi, orthonormal in the mean and exactly odd under the mirror.
    Eigen::MatrixXd bending_modes(int n) const;

    /// Half the modal derivative -K^-1 (dK/dq_j) phi_i (Barbic and James 2005), exactly even: where the tail of least
    /// energy goes, to second order, when it is bent by phi_i and phi_j.
    Eigen::VectorXd shortening(const Eigen::VectorXd &phi_i, const Eigen::VectorXd &phi_j) const;

  private:
    using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    SparseMatrix at(const Eigen::VectorXd &displacement) const;

    const Swimmer<2>                                  &swimmer_;
    const TailSpace                                   &space_;
    SparseMatrix                                       at_rest_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  };
} // namespace swimtwin
