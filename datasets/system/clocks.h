// Clocks in seconds from a start of their own: differences of two readings are the times that runs report.
#pragma once

#include <chrono>
#include <ctime>

namespace swimtwin
{
  /// Goes on at the same pace whatever is done to the machine's time of day.
  inline double wall_time_s()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  /// Of the thread that asks.
  inline double thread_cpu_time_s()
  {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  /// User and system, of all threads of this process since it started.
  inline double process_cpu_time_s()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }
} // namespace swimtwin
