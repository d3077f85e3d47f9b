// A matrix times a vector, with the widest vectors that the machine has.
#pragma once

#include <Eigen/Core>

namespace swimtwin
{
  /// result = A x; result may be no part of x. The program is built for any x86-64, whose vectors hold two numbers:
  /// this one product, of which polynomials of the shape are made, is compiled for four as well, and chosen when the
  /// program starts. Eigen's general one takes 1.1 to 1.7 times as long at the sizes of polynomials.
  void set_product(const Eigen::MatrixXd &A, const double *x, double *result);
} // namespace swimtwin
