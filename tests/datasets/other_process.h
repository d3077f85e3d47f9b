// Something done by another process while a test goes on.
#pragma once

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <csignal>
#include <functional>
#include <unistd.h>

namespace swimtwin
{
  /// Does its work, says so, and waits until it is killed by the destructor.
  class OtherProcess
  {
  public:
    explicit OtherProcess(const std::function<void()> &work)
    {
      int ready[2];
      if (::pipe(ready) != 0)
        ADD_FAILURE() << "no pipe";
      pid_ = ::fork();
      if (pid_ == 0)
      {
        work();
        [[maybe_unused]] const auto written = ::write(ready[1], "x", 1);
        for (;;)
          ::pause();
      }
      char answer = 0;
      EXPECT_EQ(::read(ready[0], &answer, 1), 1);
      ::close(ready[0]);
      ::close(ready[1]);
    }
    OtherProcess(const OtherProcess &)            = delete;
    OtherProcess &operator=(const OtherProcess &) = delete;
    ~OtherProcess() { kill(); }

    void kill()
    {
      if (pid_ > 0)
      {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
      }
      pid_ = -1;
    }
    pid_t id() const { return pid_; }

  private:
    pid_t pid_ = -1;
  };
} // namespace swimtwin
