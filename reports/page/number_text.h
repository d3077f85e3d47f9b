// Numbers as people read them.
#pragma once

#include <string>

namespace swimtwin
{
  /// How many digits are shown of a result, and of what needs fewer (errors, shares).
  inline constexpr int result_digits = 4, rounded_digits = 3;

  /// With a minus sign, not a hyphen; "not finite" for infinities and NaN.
  std::string plain_number(double value, int n_digits);

  /// The same with its sign always, as in +0.17 and −0.2.
  std::string signed_number(double value, int n_digits);

  /// 75 s as "1 min 15 s".
  std::string duration_text(double seconds);
} // namespace swimtwin
