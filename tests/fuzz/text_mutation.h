// Mutants of texts: files that something went wrong with.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace swimtwin
{
  using RandomNumbers = std::mt19937;

  /// 0 to n - 1, the same on every machine (the distributions of the standard library are not).
  std::size_t pick(RandomNumbers &random, std::size_t n);

  template <typename Range>
  auto &pick_from(RandomNumbers &random, Range &range)
  {
    return range[pick(random, std::size(range))];
  }

  /// One to four faults on top of each other in one of the seeds: bytes changed, parts cut off, taken out, repeated,
  /// moved or spliced in from another seed, words and numbers taken out, doubled, exchanged or driven to extremes.
  std::string mutated_text(const std::vector<std::string> &seeds, RandomNumbers &random);
} // namespace swimtwin
