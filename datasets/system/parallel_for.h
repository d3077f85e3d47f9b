// Independent pieces of work shared out over threads.
#pragma once

#include <datasets/system/memory_limits.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace swimtwin
{
  /// How many threads n pieces of work take when `wanted` (0: as many as the machine has) are allowed.
  inline int n_threads_for(const std::size_t n, const int wanted)
  {
    const auto        cores = static_cast<int>(std::thread::hardware_concurrency());
    const std::size_t most  = static_cast<std::size_t>(std::max(1, wanted > 0 ? wanted : cores));
    return static_cast<int>(std::min(n, most));
  }

  /// Calls make_worker() once per thread, by that thread, and then its result on every i below n, each i once. The
  /// first exception ends them all and comes back. Under a limit of memory with as many threads as there is room for.
  template <typename MakeWorker>
  void parallel_for(const std::size_t n, const int n_threads, const MakeWorker &make_worker)
  {
    const int                n_fitting = n_threads_in_memory(n_threads);
    std::atomic<std::size_t> next      = 0;
    std::exception_ptr       error;
    std::mutex               first;
    const auto               take_turns = [&] {
      try
      {
        auto worker = make_worker();
        for (std::size_t i = next++; i < n; i = next++)
          worker(i);
      }
      catch (...) // not to steer: thrown again below, in the caller's thread
      {
        const std::lock_guard lock(first);
        if (!error)
          error = std::current_exception();
        next = n;
      }
    };
    {
      std::vector<std::jthread> others;
      for (int t = 1; t < n_fitting; ++t)
        others.emplace_back(take_turns);
      take_turns();
    }
    if (error)
      std::rethrow_exception(error);
  }
} // namespace swimtwin
