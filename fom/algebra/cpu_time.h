// CPU time of parts of the work.
#pragma once

#include <datasets/system/clocks.h>

namespace swimtwin
{
  /// Adds the CPU time of a scope to a counter.
  class ScopedCpuTime
  {
  public:
    explicit ScopedCpuTime(double &counter) : counter_(counter), start_(process_cpu_time_s()) {}
    ~ScopedCpuTime() { counter_ += process_cpu_time_s() - start_; }
    ScopedCpuTime(const ScopedCpuTime &)            = delete;
    ScopedCpuTime &operator=(const ScopedCpuTime &) = delete;

  private:
    double &counter_;
    double  start_;
  };
} // namespace swimtwin
