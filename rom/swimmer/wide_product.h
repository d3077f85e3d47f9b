// A matrix times a vector, with the widest vectors that the machine has.
#pragma once

#include <Eigen/Core>

namespace swimtwin
{
  /// result = A x; result may be no part of x. The program is built for any x86-64, whose vectors hold two numbers:
  /// this one product, of which polynomials of the shape are made, is compiled for four as well, and chosen when the
  /// program starts. Below some hundred rows Eigen's general one spends half of its time on its own bookkeeping.
  void set_product(const Eigen::MatrixXd &A, const double *x, double *result);
} // namespace swimtwin
