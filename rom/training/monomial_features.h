// The monomials that a fit of the resistance may use. A set is a matrix of exponents, one monomial per row.
#pragma once

#include <Eigen/Dense>

#include <vector>

namespace swimtwin
{
  Eigen::VectorXd monomials(const Eigen::MatrixXi &exponents, const Eigen::VectorXd &z);
  /// Their values at many points, one row each.
  Eigen::MatrixXd design(const Eigen::MatrixXi &exponents, const Eigen::MatrixXd &z);

  /// 0, 1, ... n - 1: all rows, or columns.
  std::vector<int> counted(Eigen::Index n);

  /// Rows of a table for one of the turns of a cross-validation.
  struct Fold
  {
    std::vector<int> kept, held;
  };
  /// Every row but the first, rest, which is always kept, is held back in one of five.
  std::vector<Fold> five_folds(Eigen::Index n_rows);

  /// Rows of one parity. Every variable is odd, so the parity of a monomial is that of its degree.
  std::vector<int> of_parity(const Eigen::MatrixXi &exponents, int odd);

  /// Sets to choose from, each larger by a quarter or more than the one before, up to a third of the samples per
  /// parity, or in all where parities are not told apart: all monomials for which the product of the variables' effects
  /// exceeds a bound. Throws ComputationError if there are too few samples for any.
  std::vector<Eigen::MatrixXi> feature_sets(const Eigen::VectorXd &effects, Eigen::Index n_samples,
                                            bool has_parity = true);

  inline constexpr double smallest_ridge = 1e-4;

  /// Below the design matrix (rows times their `weight`): a weight, `ridge`, that keeps coefficients small where
  /// samples do not tell them, in corners of the region where the tail would touch itself. It is as large against light
  /// rows as against heavy ones.
  Eigen::MatrixXd with_ridge(const Eigen::MatrixXd &A, const Eigen::VectorXd &weight, double ridge = smallest_ridge);
} // namespace swimtwin
