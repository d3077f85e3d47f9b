// Motions that keep the tail's area, which a domain closed by walls asks for.
#pragma once

#include <rom/swimmer/reduced_swimmer.h>

namespace swimtwin
{
  /// Orthonormal directions of (angle, shape), lengths per body length, along which the area does not change: all of
  /// them in an open domain. (r + 1) x r or (r + 1) x (r + 1).
  Eigen::MatrixXd free_directions(const ReducedSwimmer &swimmer, const SwimmerState &state);
} // namespace swimtwin
