#include <rom/training/pod.h>

#include <fom/factors/petsc_error.h>

#include <algorithm>

namespace swimtwin
{
  PodBuilder::PodBuilder(const Eigen::SparseMatrix<double> &inner_product, const MPI_Comm communicator)
      : communicator_(communicator), n_(inner_product.rows())
  {
    const Eigen::SparseMatrix<double, Eigen::RowMajor> rows    = inner_product;
    PetscInt                                           n_local = PETSC_DECIDE, n = n_;
    check_petsc(PetscSplitOwnership(communicator, &n_local, &n), "divided snapshots");
    check_petsc(MatCreate(communicator, &inner_product_), "made an inner product");
    check_petsc(MatSetSizes(inner_product_, n_local, n_local, n, n), "made an inner product");
    check_petsc(MatSetType(inner_product_, MATAIJ), "made an inner product");
    check_petsc(MatSetUp(inner_product_), "made an inner product");
    check_petsc(MatSetOption(inner_product_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE), "made an inner product");
    check_petsc(MatGetOwnershipRange(inner_product_, &first_row_, &last_row_), "divided snapshots");
    for (PetscInt i = first_row_; i < last_row_; ++i)
      for (decltype(rows)::InnerIterator entry(rows, i); entry; ++entry)
        check_petsc(MatSetValue(inner_product_, i, entry.col(), entry.value(), INSERT_VALUES),
                    "filled an inner product");
    check_petsc(MatAssemblyBegin(inner_product_, MAT_FINAL_ASSEMBLY), "filled an inner product");
    check_petsc(MatAssemblyEnd(inner_product_, MAT_FINAL_ASSEMBLY), "filled an inner product");
    check_petsc(MatSetOption(inner_product_, MAT_SPD, PETSC_TRUE), "marked an inner product");

    check_petsc(MatCreateVecs(inner_product_, &snapshot_, nullptr), "made a snapshot");
    constexpr PetscInt first_capacity = 64;
    check_petsc(BVCreate(communicator, &basis_), "made a basis");
    check_petsc(BVSetSizesFromVec(basis_, snapshot_, std::min(first_capacity, n_)), "made a basis");
    check_petsc(BVSetType(basis_, BVMAT), "made a basis");
    check_petsc(
        BVSetOrthogonalization(basis_, BV_ORTHOG_CGS, BV_ORTHOG_REFINE_ALWAYS, PETSC_DEFAULT, BV_ORTHOG_BLOCK_GS),
        "made a basis");
    check_petsc(BVSetMatrix(basis_, inner_product_, PETSC_FALSE), "made a basis");
  }

  PodBuilder::~PodBuilder()
  {
    BVDestroy(&basis_);
    VecDestroy(&snapshot_);
    MatDestroy(&inner_product_);
  }

  void PodBuilder::add(const Eigen::MatrixXd &snapshots)
  {
    for (Eigen::Index j = 0; j < snapshots.cols(); ++j)
      add_snapshot(snapshots.col(j));
  }

  void PodBuilder::add_snapshot(const Eigen::VectorXd &snapshot)
  {
    // What is left below this share of the largest snapshot is round-off of the orthogonalisation.
    constexpr double round_off = 1e-15;
    PetscInt         capacity;
    check_petsc(BVGetSizes(basis_, nullptr, nullptr, &capacity), "grew a basis");
    const bool full = rank_ == n_; // nothing can be new
    if (rank_ == capacity && !full)
      check_petsc(BVResize(basis_, std::min(2 * capacity, n_), PETSC_TRUE), "grew a basis");

    double *local;
    check_petsc(VecGetArrayWrite(snapshot_, &local), "filled a snapshot");
    std::copy(snapshot.data() + first_row_, snapshot.data() + last_row_, local);
    check_petsc(VecRestoreArrayWrite(snapshot_, &local), "filled a snapshot");
    Eigen::VectorXd column(rank_ + 1);
    double          left_over = 0.;
    if (full)
      check_petsc(BVDotVec(basis_, snapshot_, column.data()), "projected a snapshot");
    else
    {
      check_petsc(BVSetActiveColumns(basis_, 0, rank_), "projected a snapshot");
      check_petsc(BVInsertVec(basis_, rank_, snapshot_), "projected a snapshot");
      check_petsc(BVOrthogonalizeColumn(basis_, rank_, column.data(), &left_over, nullptr), "projected a snapshot");
    }
    column(rank_) = left_over;
    largest_norm_ = std::max(largest_norm_, column.norm());
    if (left_over > round_off * largest_norm_ && is_new_direction(left_over))
    {
      ++rank_;
      check_petsc(BVSetActiveColumns(basis_, 0, rank_), "grew a basis");
    }
    else
      column.conservativeResize(rank_);
    coefficients_.push_back(std::move(column));
  }

  /// Scales the last column to one. Where hardly anything is left of a snapshot that may be round-off, which is not
  /// orthogonal to the basis once it is scaled: what does not survive a second orthogonalisation is no direction.
  bool PodBuilder::is_new_direction(const double left_over)
  {
    constexpr double survivor = .7;
    double           norm;
    check_petsc(BVScaleColumn(basis_, rank_, 1. / left_over), "scaled a basis");
    check_petsc(BVOrthogonalizeColumn(basis_, rank_, nullptr, &norm, nullptr), "projected a snapshot");
    if (norm < survivor)
      return false;
    check_petsc(BVScaleColumn(basis_, rank_, 1. / norm), "scaled a basis");
    return true;
  }

  Eigen::MatrixXd PodBuilder::gather_basis() const
  {
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n_, rank_);
    for (PetscInt j = 0; j < rank_; ++j)
    {
      const double *local;
      Vec           column;
      check_petsc(BVGetColumn(basis_, j, &column), "read a basis");
      check_petsc(VecGetArrayRead(column, &local), "read a basis");
      std::copy(local, local + (last_row_ - first_row_), basis.col(j).data() + first_row_);
      check_petsc(VecRestoreArrayRead(column, &local), "read a basis");
      check_petsc(BVRestoreColumn(basis_, j, &column), "read a basis");
    }
    MPI_Allreduce(MPI_IN_PLACE, basis.data(), static_cast<int>(basis.size()), MPI_DOUBLE, MPI_SUM, communicator_);
    return basis;
  }

  Pod PodBuilder::compute(const int n_modes) const
  {
    if (rank_ == 0)
      return {Eigen::MatrixXd(n_, 0), Eigen::VectorXd()};
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(rank_, n_snapshots());
    for (int j = 0; j < n_snapshots(); ++j)
      R.col(j).head(coefficients_[j].size()) = coefficients_[j];
    const Eigen::BDCSVD<Eigen::MatrixXd> svd(R, Eigen::ComputeThinU);
    const Eigen::Index                   k = std::min<Eigen::Index>(n_modes, svd.singularValues().size());
    Pod                                  pod{gather_basis() * svd.matrixU().leftCols(k), svd.singularValues()};
    for (Eigen::Index j = 0; j < k; ++j) // the sign is free: let the largest component be positive
    {
      Eigen::Index largest;
      pod.modes.col(j).cwiseAbs().maxCoeff(&largest);
      if (pod.modes(largest, j) < 0.)
        pod.modes.col(j) *= -1.;
    }
    return pod;
  }
} // namespace swimtwin
