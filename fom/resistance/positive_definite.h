// What every resistance matrix must be: symmetric and positive definite, for the flow is reciprocal and dissipates.
#pragma once

#include <deal.II/lac/full_matrix.h>

namespace swimtwin
{
  /// Largest |R_ij - R_ji| / sqrt(R_ii R_jj); NaN if one of them is.
  double largest_asymmetry(const dealii::FullMatrix<double> &R);

  /// Throws ComputationError that says what is wrong with a matrix: a number that is not finite, a diagonal or an
  /// eigenvalue that is not positive, an asymmetry far above the solver's tolerance.
  void check_resistance(const dealii::FullMatrix<double> &R, double asymmetry);
} // namespace swimtwin
