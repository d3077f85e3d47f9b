// Orthogonal triangularisation: the one operation of a square-root filter.
#pragma once

#include <Eigen/Dense>

namespace swimtwin
{
  /// Householder's QR of `rows` (k x n, k >= n) in place: its upper triangle becomes R >= 0 on the diagonal, all else
  /// zero, so that R^T R = rows^T rows. Allocates nothing; `workspace` has at least n entries.
  void triangularise(Eigen::Ref<Eigen::MatrixXd> rows, Eigen::Ref<Eigen::VectorXd> workspace);
} // namespace swimtwin
