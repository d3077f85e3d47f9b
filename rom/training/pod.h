// Proper orthogonal decomposition of snapshots in a given inner product.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <slepcbv.h>

namespace swimtwin
{
  struct Pod
  {
    Eigen::MatrixXd modes;           ///< n x k, orthonormal in the inner product, by falling singular value
    Eigen::VectorXd singular_values; ///< of all snapshots, as many as their rank; the energy of one is its square
  };

  /// Snapshots X = Q R with Q orthonormal in the inner product (SLEPc's basis vectors, Gram-Schmidt with
  /// refinement), then the singular value decomposition of the small factor R. The eigenvalues of the correlation
  /// matrix X^T M X would lose half the digits. Snapshots may be added file by file.
  class PodBuilder
  {
  public:
    /// `inner_product` is n x n, symmetric positive definite, the same on all ranks. Collective.
    PodBuilder(const Eigen::SparseMatrix<double> &inner_product, MPI_Comm communicator);
    ~PodBuilder();
    PodBuilder(const PodBuilder &)            = delete;
    PodBuilder &operator=(const PodBuilder &) = delete;

    /// Add snapshots, one per column, the same on all ranks. Collective.
    void add(const Eigen::MatrixXd &snapshots);
    int  n_snapshots() const { return static_cast<int>(coefficients_.size()); }

    /// The first n_modes modes, or as many as there are. Collective.
    Pod compute(int n_modes) const;

  private:
    void            add_snapshot(const Eigen::VectorXd &snapshot);
    bool            is_new_direction(double left_over);
    Eigen::MatrixXd gather_basis() const;

    MPI_Comm                     communicator_;
    Mat                          inner_product_ = nullptr;
    BV                           basis_         = nullptr;
    Vec                          snapshot_      = nullptr;
    PetscInt                     first_row_ = 0, last_row_ = 0, n_ = 0, rank_ = 0;
    double                       largest_norm_ = 0.;
    std::vector<Eigen::VectorXd> coefficients_; ///< columns of R
  };
} // namespace swimtwin
