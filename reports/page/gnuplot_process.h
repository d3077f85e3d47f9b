// gnuplot as a process of its own, in surroundings that are the same for every user.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  struct ProcessResult
  {
    bool        found     = false; ///< a program gnuplot is in PATH
    bool        succeeded = false; ///< it ended by itself within the limit, with exit code 0
    std::string messages;          ///< why not, or what it wrote to standard error (its beginning)
  };

  /// Run `gnuplot --default-settings ARGUMENTS` in a folder: without the user's initialisation files and variables,
  /// which choose terminals, fonts, folders and decimal signs, without input and output, and not through a shell, so
  /// that nothing needs quoting. After the limit it is killed, with what it has started. Throws std::system_error if
  /// the system gives no pipe.
  ProcessResult run_gnuplot(const std::filesystem::path &folder, const std::vector<std::string> &arguments,
                            std::chrono::milliseconds limit);
} // namespace swimtwin
