// How much memory this process may still take.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What something takes beyond what is in use, MB: address space and data of this process, and memory of the machine.
  struct MemoryNeed
  {
    double address_space_MB = 0., data_MB = 0., machine_MB = 0.;
  };

  struct MemoryLimit
  {
    enum class Of { address_space, data, machine };

    Of          of = Of::machine;
    std::string name; ///< for people: "ulimit -v"
    double      left_MB = 0.;
  };

  /// Every limit that is set: ulimit -v and -d, memory.max of the control groups, free memory of the machine. What
  /// cannot be read is no limit. `root` is where proc/ and sys/ are found.
  std::vector<MemoryLimit> memory_limits(const std::filesystem::path &root = "/");

  /// Throws ComputationError that says what is needed, what is left, and what to change: `remedy`, or the limit.
  void require_memory(const std::string &what, const MemoryNeed &need, const std::string &remedy,
                      const std::vector<MemoryLimit> &limits = memory_limits());

  /// How many of n threads a limit of the address space has room for: each takes a stack and a heap of its own. Throws
  /// std::bad_alloc where there is hardly room for one, of which libraries do not all take notice.
  int n_threads_in_memory(int n, const std::vector<MemoryLimit> &limits);
  int n_threads_in_memory(int n); ///< with the limits of this process
} // namespace swimtwin
