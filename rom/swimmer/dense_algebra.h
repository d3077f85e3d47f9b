// Decompositions of small dense matrices, compiled once: Eigen's templates were a third of every compilation around
// them.
#pragma once

#include <Eigen/Core>

#include <optional>

namespace swimtwin
{
  // Loads is Eigen::VectorXd or Eigen::MatrixXd, and so is the solution.

  /// A^-1 B, or the least squares of more rows than columns: QR with column pivoting.
  template <typename Loads>
  Loads solve_by_qr(const Eigen::MatrixXd &A, const Loads &B);
  /// The same without pivoting, for columns that are known to be independent.
  template <typename Loads>
  Loads solve_by_plain_qr(const Eigen::MatrixXd &A, const Loads &B);
  /// A^-1 B by LU with partial pivoting.
  template <typename Loads>
  Loads solve_by_lu(const Eigen::MatrixXd &A, const Loads &B);
  /// A^-1 B, A symmetric: L D L^T.
  template <typename Loads>
  Loads solve_symmetric(const Eigen::MatrixXd &A, const Loads &B);
  /// Of all least squares of A X = B the shortest, columns dependent or not. Pivots below `threshold` times the largest
  /// count as zero; none: those within rounding.
  template <typename Loads>
  Loads shortest_least_squares(const Eigen::MatrixXd &A, const Loads &B, std::optional<double> threshold = {});

  /// Orthonormal columns that span what is orthogonal to the n x k independent columns: n x (n - k).
  Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd &columns);

  /// L of A = L L^T, A symmetric and positive definite.
  Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd &A);
  /// L^-1 B, L lower triangular.
  template <typename Loads>
  Loads solve_lower(const Eigen::MatrixXd &L, const Loads &B);

  /// A = V diag(values) V^T, A symmetric; values increase, V is orthogonal.
  struct SymmetricEigen
  {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
  };
  SymmetricEigen  symmetric_eigen(const Eigen::MatrixXd &A);
  Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd &A);

  /// A = U diag(values) V^T; values decrease, V is square.
  struct RightSingular
  {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors; ///< V
  };
  RightSingular right_singular(const Eigen::MatrixXd &A);

  /// Of a square matrix that need not be symmetric; vectors are columns of no particular length.
  struct ComplexEigen
  {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors;
  };
  ComplexEigen     complex_eigen(const Eigen::MatrixXd &A);
  Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXd &A);
} // namespace swimtwin
