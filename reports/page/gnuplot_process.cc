#include <reports/page/gnuplot_process.h>

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <spawn.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    using Clock = std::chrono::steady_clock;

    constexpr std::chrono::milliseconds glance(10);

    /// For a C interface: ends with a null pointer. The texts have to stay.
    std::vector<char *> pointers_to(std::vector<std::string> &texts)
    {
      std::vector<char *> pointers;
      for (std::string &text : texts)
        pointers.push_back(text.data());
      pointers.push_back(nullptr);
      return pointers;
    }

    /// Where programs and their libraries are found is the machine's affair; all else could change a picture.
    std::vector<std::string> environment()
    {
      std::vector<std::string> variables = {"LC_ALL=C.UTF-8"};
      for (const char *name : {"PATH", "LD_LIBRARY_PATH"})
        if (const char *value = std::getenv(name))
          variables.push_back(fmt::format("{}={}", name, value));
      return variables;
    }

    /// What the child writes to standard error.
    class MessagePipe
    {
    public:
      MessagePipe()
      {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
          throw std::system_error(errno, std::generic_category());
        ::fcntl(ends_[0], F_SETFL, O_NONBLOCK);
      }
      MessagePipe(const MessagePipe &)            = delete;
      MessagePipe &operator=(const MessagePipe &) = delete;
      ~MessagePipe()
      {
        ::close(ends_[0]);
        close_write_end();
      }

      int  write_end() const { return ends_[1]; }
      void close_write_end()
      {
        if (ends_[1] >= 0)
          ::close(ends_[1]);
        ends_[1] = -1;
      }

      /// Take what is there, and wait a moment for more while there may be more.
      void listen()
      {
        pollfd waiting{ends_[0], POLLIN, 0};
        if (is_open_ && ::poll(&waiting, 1, static_cast<int>(glance.count())) >= 0)
          return take();
        std::this_thread::sleep_for(glance);
      }
      void take()
      {
        constexpr std::size_t  most = 4000; // kept of a program that never stops complaining
        std::array<char, 4096> buffer{};
        const ssize_t          n = ::read(ends_[0], buffer.data(), buffer.size());
        if (n == 0)
          is_open_ = false;
        if (n > 0)
          messages.append(buffer.data(), std::min(static_cast<std::size_t>(n), most - messages.size()));
      }

      std::string messages;

    private:
      std::array<int, 2> ends_{-1, -1};
      bool               is_open_ = true;
    };

    /// A process group of its own, so that what it starts can be ended with it.
    class Surroundings
    {
    public:
      Surroundings(const fs::path &folder, const int standard_error)
      {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, standard_error, STDERR_FILENO);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
      }
      Surroundings(const Surroundings &)            = delete;
      Surroundings &operator=(const Surroundings &) = delete;
      ~Surroundings()
      {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
      }

      /// 0, or why not.
      int start(std::vector<std::string> arguments, pid_t &child) const
      {
        std::vector<std::string> variables = environment();
        arguments.insert(arguments.begin(), {"gnuplot", "--default-settings"});
        return ::posix_spawnp(&child, "gnuplot", &actions_, &attributes_, pointers_to(arguments).data(),
                              pointers_to(variables).data());
      }

    private:
      posix_spawn_file_actions_t actions_;
      posix_spawnattr_t          attributes_;
    };

    /// The exit status of a child that has ended; none while it runs.
    std::optional<int> status_of(const pid_t child, const int options)
    {
      int   status = 0;
      pid_t ended  = 0;
      do
        ended = ::waitpid(child, &status, options);
      while (ended < 0 && errno == EINTR);
      return ended == 0 ? std::nullopt : std::optional(ended == child ? status : -1);
    }
    std::string how_it_ended(const int status)
    {
      return WIFSIGNALED(status) ? fmt::format("it was ended by signal {}", WTERMSIG(status))
                                 : fmt::format("it ended with exit code {}", WEXITSTATUS(status));
    }
  } // namespace

  ProcessResult run_gnuplot(const fs::path &folder, const std::vector<std::string> &arguments,
                            const std::chrono::milliseconds limit)
  {
    MessagePipe        pipe;
    const Surroundings surroundings(folder, pipe.write_end());
    pid_t              child = 0;
    if (const int error = surroundings.start(arguments, child))
      return {error != ENOENT, false, std::generic_category().message(error)};
    pipe.close_write_end();

    const auto         end    = Clock::now() + limit;
    std::optional<int> status = status_of(child, WNOHANG);
    for (; !status && Clock::now() < end; status = status_of(child, WNOHANG))
      pipe.listen();
    if (!status)
    {
      ::kill(-child, SIGKILL);
      status_of(child, 0);
      return {true, false, fmt::format("it did not end within {:g} s", std::chrono::duration<double>(limit).count())};
    }
    pipe.take();
    return {true, *status == 0, pipe.messages.empty() ? how_it_ended(*status) : pipe.messages};
  }
} // namespace swimtwin
