#include <rom/training/tail_stiffness.h>

#include <datasets/system/error.h>
#include <fom/factors/petsc_error.h>

#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace swimtwin
{
  namespace
  {
    using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    Mat to_petsc(const SparseMatrix &matrix)
    {
      Mat result;
      check_petsc(MatCreateSeqAIJ(PETSC_COMM_SELF, matrix.rows(), matrix.cols(), 64, nullptr, &result),
                  "made a matrix");
      check_petsc(MatSetOption(result, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE), "made a matrix");
      for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (SparseMatrix::InnerIterator entry(matrix, i); entry; ++entry)
          check_petsc(MatSetValue(result, i, entry.col(), entry.value(), INSERT_VALUES), "filled a matrix");
      check_petsc(MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY), "filled a matrix");
      check_petsc(MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY), "filled a matrix");
      return result;
    }

    /// Eigenvectors of the smallest eigenvalues of K phi = omega^2 M phi, one per column.
    Eigen::MatrixXd lowest_modes(const SparseMatrix &K, const SparseMatrix &M, const int n)
    {
      Mat k = to_petsc(K), m = to_petsc(M);
      EPS solver;
      ST  shift;
      check_petsc(EPSCreate(PETSC_COMM_SELF, &solver), "made an eigensolver");
      check_petsc(EPSSetOperators(solver, k, m), "made an eigensolver");
      check_petsc(EPSSetProblemType(solver, EPS_GHEP), "made an eigensolver");
      check_petsc(EPSSetDimensions(solver, n, PETSC_DEFAULT, PETSC_DEFAULT), "made an eigensolver");
      check_petsc(EPSSetTarget(solver, 0.), "made an eigensolver");
      check_petsc(EPSSetWhichEigenpairs(solver, EPS_TARGET_MAGNITUDE), "made an eigensolver");
      check_petsc(EPSSetTolerances(solver, 1e-12, 500), "made an eigensolver");
      check_petsc(EPSGetST(solver, &shift), "made an eigensolver");
      check_petsc(STSetType(shift, STSINVERT), "made an eigensolver");
      check_petsc(EPSSolve(solver), "looked for elastic modes");
      PetscInt n_found;
      check_petsc(EPSGetConverged(solver, &n_found), "looked for elastic modes");
      Eigen::MatrixXd modes(K.rows(), std::min<PetscInt>(n, n_found));
      Vec             mode;
      check_petsc(MatCreateVecs(k, &mode, nullptr), "made a vector");
      for (PetscInt j = 0; j < modes.cols(); ++j)
      {
        const double *values;
        check_petsc(EPSGetEigenvector(solver, j, mode, nullptr), "read elastic modes");
        check_petsc(VecGetArrayRead(mode, &values), "read elastic modes");
        modes.col(j) = Eigen::Map<const Eigen::VectorXd>(values, K.rows());
        check_petsc(VecRestoreArrayRead(mode, &values), "read elastic modes");
      }
      VecDestroy(&mode);
      EPSDestroy(&solver);
      MatDestroy(&m);
      MatDestroy(&k);
      return modes;
    }

    /// The mean product with clamped components taken out, which gives them eigenvalues that are never among the
    /// lowest.
    SparseMatrix mass_of_free_nodes(const Swimmer<2> &swimmer, const TailSpace &space)
    {
      SparseMatrix M = space.mean_product;
      M.prune([&](const Eigen::Index row, const Eigen::Index column, double) {
        return !swimmer.is_clamped(row / 2) && !swimmer.is_clamped(column / 2);
      });
      const double scale = M.diagonal().maxCoeff();
      for (unsigned int a = 0; a < swimmer.tail().mesh.n_nodes(); ++a)
        if (swimmer.is_clamped(a))
          for (int i = 0; i < 2; ++i)
            M.coeffRef(2 * a + i, 2 * a + i) = 1e-12 * scale;
      return M;
    }
  } // namespace

  TailStiffness::TailStiffness(const Swimmer<2> &swimmer, const TailSpace &space)
      : swimmer_(swimmer), space_(space), at_rest_(at(Eigen::VectorXd::Zero(2 * swimmer.tail().mesh.n_nodes())))
  {
    solver_.compute(at_rest_);
    if (solver_.info() != Eigen::Success)
      throw ComputationError("the tail's stiffness at rest is not positive definite: change [numerics] mesh_size_m");
  }

  TailStiffness::SparseMatrix TailStiffness::at(const Eigen::VectorXd &displacement) const
  {
    const auto   &mesh = swimmer_.tail().mesh;
    NodalField<2> field(mesh.n_nodes());
    for (unsigned int a = 0; a < field.size(); ++a)
      field[a] = dealii::Tensor<1, 2>({displacement(2 * a), displacement(2 * a + 1)});
    std::vector<Eigen::Triplet<double>> entries;
    ElasticTail<2>::CellForce           force;
    ElasticTail<2>::CellTangent         tangent;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      swimmer_.elasticity().cell_force_and_tangent(c, field, force, tangent);
      for (unsigned int i = 0; i < force.size(); ++i)
        for (unsigned int j = 0; j < force.size(); ++j)
        {
          const unsigned int a = mesh.cells[c][i / 2], b = mesh.cells[c][j / 2];
          if (!swimmer_.is_clamped(a) && !swimmer_.is_clamped(b))
            entries.emplace_back(2 * a + i % 2, 2 * b + j % 2, tangent[i][j]);
        }
    }
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      if (swimmer_.is_clamped(a))
        for (unsigned int i = 0; i < 2; ++i)
          entries.emplace_back(2 * a + i, 2 * a + i, 1.);
    SparseMatrix K(2 * mesh.n_nodes(), 2 * mesh.n_nodes());
    K.setFromTriplets(entries.begin(), entries.end());
    return K;
  }

  Eigen::VectorXd TailStiffness::shortening(const Eigen::VectorXd &phi_i, const Eigen::VectorXd &phi_j) const
  {
    // The tangent is quadratic in the displacement, so a central difference has its linear part exactly.
    const double          step = swimmer_.scene().body_length_m() / phi_j.cwiseAbs().maxCoeff();
    const Eigen::VectorXd load = (at(step * phi_j) * phi_i - at(-step * phi_j) * phi_i) / (2. * step);
    const Eigen::VectorXd half = -.5 * solver_.solve(load);
    return (half + space_.mirrored(half)) / 2.;
  }

  Eigen::MatrixXd TailStiffness::bending_modes(const int n) const
  {
    const Eigen::MatrixXd all = lowest_modes(at_rest_, mass_of_free_nodes(swimmer_, space_), 3 * n + 4);
    Eigen::MatrixXd       bending;
    for (Eigen::Index j = 0; j < all.cols() && bending.cols() < n; ++j)
    {
      const Eigen::VectorXd odd  = (all.col(j) - space_.mirrored(all.col(j))) / 2.;
      const Eigen::VectorXd left = space_.orthogonal_part(bending, odd);
      if (space_.norm(left) > .5 * space_.norm(all.col(j)))
        append_column(bending, left / space_.norm(left));
    }
    return bending;
  }
} // namespace swimtwin
