// How the size of an eigenvalue of a period's map changes with parameters.
#pragma once

#include <Eigen/Dense>

#include <complex>
#include <functional>

namespace swimtwin
{
  /// d|lambda|/dp for an eigenvalue of a real matrix M, simple, real or one of a complex pair, from `change_along`(r):
  /// the columns (dM/dp_j) r for a real vector r. It is asked once for a real eigenvalue, twice for a complex one.
  Eigen::RowVectorXd multiplier_slopes(const Eigen::MatrixXd &M, std::complex<double> lambda,
                                       const std::function<Eigen::MatrixXd(const Eigen::VectorXd &r)> &change_along);
} // namespace swimtwin
