// Which of some names a word was meant to be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  /// The candidate of smallest edit distance; empty if there are none.
  std::string nearest_name(std::string_view word, const std::vector<std::string> &candidates);

  /// The same without regard to case, and only if it is close: at most one letter in four is another one, or
  /// everything but the ending is the same.
  std::optional<std::string> close_name(const std::string &word, const std::vector<std::string> &candidates);
} // namespace swimtwin
