// Factors from SI units to those that people read: shown = factor x value.
#pragma once

#include <numbers>

namespace swimtwin
{
  inline constexpr double mm = 1e3, um = 1e6, mT = 1e3, uJ = 1e6, nJ = 1e9, ms = 1e3, percent = 100.,
                          degrees = 180. / std::numbers::pi;
} // namespace swimtwin
