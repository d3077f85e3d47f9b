// Values of an option: numbers, ranges, and lists of both.
#pragma once

#include <string>
#include <vector>

namespace swimtwin
{
  enum class ValueRule { positive, finite };

  /// "0.8", "5e4,8e4,2e5", "0.1:3:60" (60 values, equally spaced, both ends included), "0.1:3:60:log" (equal ratios),
  /// or a list of such. Throws InputError with option, value, rule and remedy.
  std::vector<double> parse_values(const std::string &option, const std::string &text, ValueRule rule);

  /// "1%" or "0.01", of a difference that counts as agreement: a fifth at most. Throws InputError.
  double parse_share(const std::string &option, const std::string &text);
} // namespace swimtwin
