// The usual step between instants.
#pragma once

#include <vector>

namespace swimtwin
{
  /// Median of the differences of at least two numbers (the upper one of the two in the middle).
  double median_step(const std::vector<double> &time_s);
} // namespace swimtwin
