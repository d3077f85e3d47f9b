// Least squares with coefficients that must not be negative.
#pragma once

#include <Eigen/Dense>

namespace swimtwin
{
  /// The c >= 0 that minimises |A c - b|; A is m x n. Active sets after Lawson and Hanson, Solving Least Squares
  /// Problems (1974), chapter 23.
  Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd &A, const Eigen::VectorXd &b);
} // namespace swimtwin
