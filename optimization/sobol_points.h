// Points that fill a box evenly.
#pragma once

#include <Eigen/Dense>

namespace swimtwin
{
  /// The first points of Sobol's sequence (without the corner that it begins with) between the bounds, one per column;
  /// all shifted by the same random vector, modulo the box, unless the seed is 0. Throws InputError for bounds that are
  /// not finite.
  Eigen::MatrixXd sobol_points(const Eigen::VectorXd &lower, const Eigen::VectorXd &upper, int n_points,
                               unsigned long seed);
} // namespace swimtwin
