// The instants at which pictures show a swimmer.
#pragma once

#include <reports/run/run_picture.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace swimtwin
{
  /// Of n entries with times (s) those closest to so many times evenly over the last full period, its end left out (it
  /// is its beginning); without a period over the whole run with both ends. Indices, each once.
  std::vector<std::size_t> closest_instants(const ShownRun &run, int n_instants, std::size_t n,
                                            const std::function<double(std::size_t)> &time_s_of);

  /// The phase in periods from the beginning of the last full period, or s without a period.
  double shown_time(const ShownRun &run, double time_s);
} // namespace swimtwin
