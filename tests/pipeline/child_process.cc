#include <tests/pipeline/child_process.h>

#include <tests/places.h>

#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <sstream>
#include <thread>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    // Only calls that are safe between fork and exec.
    [[noreturn]] void become(char *const *words, const char *out, const char *err)
    {
      dup2(open(out, O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
      dup2(open(err, O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
      execvp(words[0], words);
      _exit(127);
    }
  } // namespace

  ChildProcess::ChildProcess(std::vector<std::string> words)
  {
    std::vector<char *> pointers;
    for (auto &word : words)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const std::string out = folder_.path / "out", err = folder_.path / "err";
    pid_ = fork();
    if (pid_ == 0)
      become(pointers.data(), out.c_str(), err.c_str());
    if (pid_ < 0)
      ADD_FAILURE() << "cannot start " << words[0];
  }

  ChildProcess::~ChildProcess()
  {
    kill();
  }

  bool ChildProcess::has_ended()
  {
    int status = 0;
    if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_)
      status_ = status;
    return status_.has_value();
  }

  bool ChildProcess::kill()
  {
    if (pid_ <= 0 || has_ended())
      return false;
    ::kill(pid_, SIGKILL);
    wait();
    return true;
  }

  std::vector<pid_t> ChildProcess::children() const
  {
    std::vector<pid_t> found;
    std::error_code    ignored; // processes come and go
    for (std::filesystem::directory_iterator entry("/proc", ignored), end; entry != end; entry.increment(ignored))
      if (const std::string name = entry->path().filename().string(); std::isdigit(static_cast<unsigned char>(name[0])))
      {
        const std::string  stat = content(entry->path() / "stat"); // number (name) state parent ...
        std::istringstream rest(stat.substr(std::min(stat.rfind(')') + 1, stat.size())));
        std::string        state;
        pid_t              parent = 0;
        if (rest >> state >> parent && parent == pid_ && state != "Z")
          found.push_back(std::stoi(name));
      }
    std::sort(found.begin(), found.end());
    return found;
  }

  Outcome ChildProcess::wait()
  {
    int status = 0;
    if (!status_ && waitpid(pid_, &status, 0) == pid_)
      status_ = status;
    const bool exited = status_ && WIFEXITED(*status_);
    return {exited ? WEXITSTATUS(*status_) : -1, content(folder_.path / "out"), content(folder_.path / "err")};
  }

  bool ChildProcess::wait_until(const std::function<bool()> &condition)
  {
    using namespace std::chrono;
    for (const auto end = steady_clock::now() + minutes(5); steady_clock::now() < end && !has_ended();)
    {
      if (condition())
        return true;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return false;
  }

  bool ChildProcess::wait_for_file(const std::filesystem::path &file)
  {
    return wait_until([&] { return std::filesystem::exists(file); });
  }

  Outcome run(const std::vector<std::string> &words)
  {
    return ChildProcess(words).wait();
  }

  std::vector<std::string> tool(const std::vector<std::string> &arguments)
  {
    std::vector<std::string> words{places::tool};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }

  Outcome run_tool(const std::vector<std::string> &arguments)
  {
    return run(tool(arguments));
  }

  void expect_failure(const Outcome &outcome, const int exit_code, const std::vector<std::string> &parts)
  {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.substr(0, 10), "swimtwin: ") << outcome.err;
    for (const auto &part : parts)
      expect_in(outcome.err, part);
  }
} // namespace swimtwin
