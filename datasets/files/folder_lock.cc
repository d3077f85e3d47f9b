#include <datasets/files/folder_lock.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <future>
#include <map>
#include <mutex>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    const char *const lock_name = ".swimtwin.lock";

    int try_lock(const int descriptor, const int operation)
    {
      return ::flock(descriptor, operation | LOCK_NB) == 0 ? 0 : errno;
    }

    /// flock, given up after a while: the server of a network's file system may not answer. Returns errno.
    int lock_in_time(const int descriptor, const int operation)
    {
      constexpr std::chrono::seconds patience(10);
      const int                      copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0); // outlives the patience
      std::packaged_task<int()>      task([copy, operation] {
        const int error = try_lock(copy, operation);
        ::close(copy); // the lock lives on in the other descriptor
        return error;
      });
      auto                           answer = task.get_future();
      try
      {
        std::thread(std::move(task)).detach();
      }
      catch (const std::system_error &) // this user may have no more threads
      {
        ::close(copy);
        return try_lock(descriptor, operation);
      }
      return answer.wait_for(patience) == std::future_status::ready ? answer.get() : ETIMEDOUT;
    }

    /// For this process alone. Who only looks whether a run goes on holds the lock for a moment: try again.
    int lock_alone(const int descriptor)
    {
      int error = EWOULDBLOCK;
      for (int attempt = 0; error == EWOULDBLOCK && attempt < 3; ++attempt)
      {
        if (attempt > 0)
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
        error = lock_in_time(descriptor, LOCK_EX);
      }
      return error;
    }

    std::string host_name()
    {
      std::array<char, 256> name{};
      return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
    }

    std::string this_process(std::string command_line)
    {
      constexpr std::size_t longest = 300;
      std::replace(command_line.begin(), command_line.end(), '\n', ' ');
      if (command_line.size() > longest)
        command_line = command_line.substr(0, longest) + " ...";
      return fmt::format("process {} on {} since {}: {}", ::getpid(), host_name(), utc_time_now(), command_line);
    }

    /// What the holder wrote, a moment after it took the lock.
    std::string read_holder(const int descriptor)
    {
      constexpr int attempts = 20;
      for (int i = 0; i < attempts; ++i)
      {
        std::array<char, 1024> text{};
        const ssize_t          n = ::pread(descriptor, text.data(), text.size(), 0);
        if (n > 0)
          return {text.data(), static_cast<std::size_t>(n)};
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      return "another process";
    }

    using FileNumber = std::pair<dev_t, ino_t>;

    std::optional<FileNumber> number_of(const fs::path &path)
    {
      struct ::stat status = {};
      if (::stat(path.c_str(), &status) != 0)
        return std::nullopt;
      return FileNumber{status.st_dev, status.st_ino};
    }

    /// Whether the open file is the one of that name, not one that its last holder has removed.
    bool is_file_of_name(const int descriptor, const fs::path &name)
    {
      struct ::stat status = {};
      return ::fstat(descriptor, &status) == 0 && number_of(name) == FileNumber{status.st_dev, status.st_ino};
    }

    /// Another user's file, left by a run that was killed, can be locked but not written.
    int open_lock_file(const fs::path &file)
    {
      const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
      return descriptor >= 0 || errno != EACCES ? descriptor : ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    }

    std::string doubt_of(const int error)
    {
      if (error == ENOSPC || error == EDQUOT) // told by what fails next
        return {};
      return fmt::format("the folder cannot be locked ({}): start no second run in it",
                         std::generic_category().message(error));
    }
  } // namespace

  class HeldLock
  {
  public:
    HeldLock(const fs::path &folder, const std::string &command_line) : file_(folder / lock_name)
    {
      do
      {
        close();
        descriptor_ = open_lock_file(file_);
        if (descriptor_ < 0)
        {
          doubt = doubt_of(errno);
          return;
        }
        const int error = lock_alone(descriptor_);
        if (error == EWOULDBLOCK)
          refuse(folder);
        if (error != 0)
          doubt = doubt_of(error);
      } while (doubt.empty() && !is_file_of_name(descriptor_, file_));
      if (doubt.empty())
        write(this_process(command_line));
    }
    HeldLock(const HeldLock &)            = delete;
    HeldLock &operator=(const HeldLock &) = delete;
    ~HeldLock()
    {
      std::error_code ignored; // before the lock ends: another may hold the next file of that name
      if (descriptor_ >= 0)
        fs::remove(file_, ignored);
      close();
    }

    std::string doubt;

  private:
    [[noreturn]] void refuse(const fs::path &folder)
    {
      const std::string holder = read_holder(descriptor_);
      close();
      throw InputError(fmt::format("{} is in use by {}; wait for the end of that run, or choose another --output.",
                                   folder.string(), holder));
    }

    /// For others to read; nothing depends on it.
    void write(const std::string &text)
    {
      if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, text.data(), text.size(), 0) < 0)
        return;
    }

    void close()
    {
      if (descriptor_ >= 0)
        ::close(std::exchange(descriptor_, -1));
    }

    fs::path file_;
    int      descriptor_ = -1;
  };

  namespace
  {
    /// The locks of this process, by folder.
    class OwnLocks
    {
    public:
      std::shared_ptr<HeldLock> find(const fs::path &folder)
      {
        const std::lock_guard guard(mutex_);
        const auto            number = number_of(folder);
        return number ? locks_[*number].lock() : nullptr;
      }

      void add(const fs::path &folder, const std::shared_ptr<HeldLock> &lock)
      {
        const std::lock_guard guard(mutex_);
        if (const auto number = number_of(folder))
          locks_[*number] = lock;
      }

    private:
      std::mutex                                    mutex_;
      std::map<FileNumber, std::weak_ptr<HeldLock>> locks_;
    };

    OwnLocks &own_locks()
    {
      static OwnLocks locks;
      return locks;
    }
  } // namespace

  FolderLock::FolderLock(const fs::path &folder, const std::string &command_line) : held_(own_locks().find(folder))
  {
    outermost_ = !held_;
    if (!outermost_)
      return;
    held_ = std::make_shared<HeldLock>(folder, command_line);
    own_locks().add(folder, held_);
  }

  const std::string &FolderLock::doubt() const
  {
    return held_->doubt;
  }

  std::optional<std::string> run_in(const fs::path &folder)
  {
    const int descriptor = own_locks().find(folder) ? -1 : ::open((folder / lock_name).c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      return std::nullopt;
    std::optional<std::string> holder;
    if (lock_in_time(descriptor, LOCK_SH) == EWOULDBLOCK)
      holder = read_holder(descriptor);
    ::close(descriptor);
    return holder;
  }
} // namespace swimtwin
