// A command as a child process: what it printed, how it ended, and what happens when it is killed.
#pragma once

#include <tests/datasets/temporary_folder.h>

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  struct Outcome
  {
    int         exit_code = -1; ///< -1: ended by a signal
    std::string out, err;
  };

  /// Started by the constructor, killed by the destructor if it still runs.
  class ChildProcess
  {
  public:
    explicit ChildProcess(std::vector<std::string> words);
    ChildProcess(const ChildProcess &)            = delete;
    ChildProcess &operator=(const ChildProcess &) = delete;
    ~ChildProcess();

    /// kill -9, and wait until it is gone. False if it had ended by itself.
    bool kill();
    /// The processes that it has started itself and that still run, the oldest first.
    std::vector<pid_t> children() const;
    /// Wait for its end.
    Outcome wait();
    /// Wait until something is so; false if the process ends before, or a minute passes.
    bool wait_until(const std::function<bool()> &condition);
    bool wait_for_file(const std::filesystem::path &file);

  private:
    bool has_ended();

    TemporaryFolder    folder_; // of what it prints
    pid_t              pid_ = -1;
    std::optional<int> status_;
  };

  Outcome run(const std::vector<std::string> &words);

  /// The tool with these arguments.
  std::vector<std::string> tool(const std::vector<std::string> &arguments);
  Outcome                  run_tool(const std::vector<std::string> &arguments);

  /// That the tool refuses: exit code, one line that starts with its name, and these parts in it.
  void expect_failure(const Outcome &outcome, int exit_code, const std::vector<std::string> &parts);
} // namespace swimtwin
