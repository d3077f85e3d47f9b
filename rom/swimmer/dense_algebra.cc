#include <rom/swimmer/dense_algebra.h>

#include <Eigen/Dense>

namespace swimtwin
{
  using Eigen::MatrixXd;
  using Eigen::VectorXcd;
  using Eigen::VectorXd;

  template <typename Loads>
  Loads solve_by_qr(const MatrixXd &A, const Loads &B)
  {
    return A.colPivHouseholderQr().solve(B);
  }

  template <typename Loads>
  Loads solve_by_plain_qr(const MatrixXd &A, const Loads &B)
  {
    return A.householderQr().solve(B);
  }

  template <typename Loads>
  Loads solve_by_lu(const MatrixXd &A, const Loads &B)
  {
    return A.partialPivLu().solve(B);
  }

  template <typename Loads>
  Loads solve_symmetric(const MatrixXd &A, const Loads &B)
  {
    return A.ldlt().solve(B);
  }

  template <typename Loads>
  Loads shortest_least_squares(const MatrixXd &A, const Loads &B, const std::optional<double> threshold)
  {
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(A);
    if (threshold)
      solver.setThreshold(*threshold);
    return solver.solve(B);
  }

  MatrixXd orthogonal_complement(const MatrixXd &columns)
  {
    const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(columns).householderQ();
    return Q.rightCols(columns.rows() - columns.cols());
  }

  MatrixXd cholesky_factor(const MatrixXd &A)
  {
    return A.llt().matrixL();
  }

  template <typename Loads>
  Loads solve_lower(const MatrixXd &L, const Loads &B)
  {
    return L.triangularView<Eigen::Lower>().solve(B);
  }

  SymmetricEigen symmetric_eigen(const MatrixXd &A)
  {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(A);
    return {solver.eigenvalues(), solver.eigenvectors()};
  }

  VectorXd symmetric_eigenvalues(const MatrixXd &A)
  {
    return Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
  }

  RightSingular right_singular(const MatrixXd &A)
  {
    const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullV);
    return {svd.singularValues(), svd.matrixV()};
  }

  ComplexEigen complex_eigen(const MatrixXd &A)
  {
    const Eigen::EigenSolver<MatrixXd> solver(A);
    return {solver.eigenvalues(), solver.eigenvectors()};
  }

  VectorXcd complex_eigenvalues(const MatrixXd &A)
  {
    return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues();
  }

  template VectorXd solve_by_qr(const MatrixXd &, const VectorXd &);
  template MatrixXd solve_by_qr(const MatrixXd &, const MatrixXd &);
  template VectorXd solve_by_plain_qr(const MatrixXd &, const VectorXd &);
  template MatrixXd solve_by_plain_qr(const MatrixXd &, const MatrixXd &);
  template VectorXd solve_by_lu(const MatrixXd &, const VectorXd &);
  template MatrixXd solve_by_lu(const MatrixXd &, const MatrixXd &);
  template VectorXd solve_symmetric(const MatrixXd &, const VectorXd &);
  template MatrixXd solve_symmetric(const MatrixXd &, const MatrixXd &);
  template VectorXd shortest_least_squares(const MatrixXd &, const VectorXd &, std::optional<double>);
  template MatrixXd shortest_least_squares(const MatrixXd &, const MatrixXd &, std::optional<double>);
  template VectorXd solve_lower(const MatrixXd &, const VectorXd &);
  template MatrixXd solve_lower(const MatrixXd &, const MatrixXd &);
} // namespace swimtwin
