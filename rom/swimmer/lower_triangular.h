// Lower triangular matrices of a few rows, as plain loops over their halves: Eigen's products multiply the
// zeros too.
#pragma once

#include <rom/swimmer/state_vectors.h>

namespace swimtwin
{
  // What stands above the diagonal of L, A, B and F is not looked at.

  /// A B, lower triangular too.
  void set_lower_product(const VelocityMatrix &A, const VelocityMatrix &B, VelocityMatrix &product);
  /// sum += weight F F^T; of the sum the lower half.
  void add_lower_square(double weight, const VelocityMatrix &F, VelocityMatrix &sum);
  /// L x.
  VelocityVector lower_times(const VelocityMatrix &L, const VelocityVector &x);
  /// L^T x.
  VelocityVector transposed_lower_times(const VelocityMatrix &L, const VelocityVector &x);
} // namespace swimtwin
