// CPU time of this process, and of parts of its work.
#pragma once

#include <ctime>

namespace swimtwin
{
  /// Seconds, user and system, since the process started.
  inline double cpu_seconds()
  {
    return double(std::clock()) / CLOCKS_PER_SEC;
  }

  /// Adds the CPU time of a scope to a counter.
  class ScopedCpuTime
  {
  public:
    explicit ScopedCpuTime(double &counter) : counter_(counter), start_(cpu_seconds()) {}
    ~ScopedCpuTime() { counter_ += cpu_seconds() - start_; }
    ScopedCpuTime(const ScopedCpuTime &)            = delete;
    ScopedCpuTime &operator=(const ScopedCpuTime &) = delete;

  private:
    double &counter_;
    double  start_;
  };
} // namespace swimtwin
