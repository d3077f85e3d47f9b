// Independent pieces of work on several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace swimtwin
{
  /// Calls work(i) for all i below n, where each thread has a `work` of its own from `make_worker()`. The first
  /// exception ends them all and comes back.
  template <typename MakeWorker>
  void share_work(const std::size_t n, const int n_threads, const MakeWorker &make_worker)
  {
    std::atomic<std::size_t> next = 0;
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
      for (int t = 1; t < n_threads; ++t)
        others.emplace_back(take_turns);
      take_turns();
    }
    if (error)
      std::rethrow_exception(error);
  }
} // namespace swimtwin
