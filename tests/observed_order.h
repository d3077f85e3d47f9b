// Orders of convergence.
#pragma once

#include <cmath>

namespace swimtwin
{
  inline double observed_order(const double coarse_error, const double fine_error, const double size_ratio)
  {
    return std::log(coarse_error / fine_error) / std::log(size_ratio);
  }
} // namespace swimtwin
