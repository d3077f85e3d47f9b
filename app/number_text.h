// Numbers as people read them.
#pragma once

#include <string>

namespace swimtwin
{
  /// With a minus sign, not a hyphen; "not finite" for infinities and NaN.
  std::string plain_number(double value, int n_digits);

  /// The same with its sign always, as in +0.17 and −0.2.
  std::string signed_number(double value, int n_digits);
} // namespace swimtwin
