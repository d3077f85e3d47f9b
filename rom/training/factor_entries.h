// A positive definite matrix as numbers that may be anything: the entries of a Cholesky factor.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace swimtwin
{
  /// L_0 of a resistance at rest, with what the mirror forbids taken out: s_i s_j = -1 entries are zero.
  Eigen::MatrixXd factor_at_rest(const Eigen::MatrixXd &rest, bool has_mirror = true);

  /// Entries of C (row by row, j <= i, diagonal as logarithm) of a resistance: L_0 C C^T L_0^T.
  Eigen::VectorXd factor_entries(const Eigen::MatrixXd &factor_at_rest, const Eigen::MatrixXd &resistance);

  /// L^-1 A L^-T: the symmetric A in the coordinates where L L^T is the identity.
  Eigen::MatrixXd seen_from(const Eigen::MatrixXd &L, const Eigen::MatrixXd &A);

  /// Effects of the variables from samples at the region's edge on each axis: largest entry of C - 1 there, at least
  /// 1e-4. `rest` and `axis` hold the resistance at rest and at z = e_i.
  Eigen::VectorXd variable_effects(const Eigen::MatrixXd &rest, const std::vector<Eigen::MatrixXd> &axis,
                                   bool has_mirror = true);

  /// Parity under the mirror of generalised velocity i: +1 along the axis, -1 across, turning and bending.
  constexpr int velocity_parity(const int i)
  {
    return i == 0 ? 1 : -1;
  }

  /// C of its entries, n x n.
  Eigen::MatrixXd factor_of(const Eigen::VectorXd &entries, Eigen::Index n);

  /// Largest relative error, for any motion, of a resistance with fitted entries.
  double relative_error(const Eigen::VectorXd &fitted, const Eigen::VectorXd &truth, Eigen::Index n);

  /// Largest condition of the resistances, seen from that at rest, that these entries of C stand for, one row each.
  double largest_condition(const Eigen::MatrixXd &entries, Eigen::Index n);
} // namespace swimtwin
