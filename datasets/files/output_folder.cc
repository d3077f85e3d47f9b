#include <datasets/files/output_folder.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <random>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    [[noreturn]] void throw_errno(const int number)
    {
      throw std::system_error(number, std::generic_category());
    }

    /// Closes on the way out; `close` reports what the destructor cannot.
    class FileDescriptor
    {
    public:
      FileDescriptor(const fs::path &file, const int flags) : descriptor_(::open(file.c_str(), flags | O_CLOEXEC, 0644))
      {
        if (descriptor_ < 0)
          throw_errno(errno);
      }
      FileDescriptor(const FileDescriptor &)            = delete;
      FileDescriptor &operator=(const FileDescriptor &) = delete;
      ~FileDescriptor()
      {
        if (descriptor_ >= 0)
          ::close(descriptor_);
      }

      void write(const char *data, std::size_t size)
      {
        while (size > 0)
        {
          const ssize_t written = ::write(descriptor_, data, size);
          if (written < 0 && errno == EINTR)
            continue;
          if (written <= 0)
            throw_errno(written < 0 ? errno : ENOSPC);
          data += written;
          size -= static_cast<std::size_t>(written);
        }
      }
      void flush_to_disk()
      {
        // some file systems and special files cannot be flushed: EINVAL and ENOTSUP say so, nothing was lost
        if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
          throw_errno(errno);
      }
      void close()
      {
        if (::close(std::exchange(descriptor_, -1)) != 0)
          throw_errno(errno);
      }

    private:
      int descriptor_;
    };

    /// Removes the temporary file unless it got its final name.
    class PartialFile
    {
    public:
      explicit PartialFile(const fs::path &final_name) : path(temporary_name(final_name)) {}
      PartialFile(const PartialFile &)            = delete;
      PartialFile &operator=(const PartialFile &) = delete;
      ~PartialFile()
      {
        std::error_code ignored; // nothing is left to remove after the renaming
        fs::remove(path, ignored);
      }

      const fs::path path;
    };

    void flush_folder(const fs::path &folder)
    {
      FileDescriptor descriptor(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY);
      descriptor.flush_to_disk();
    }

    void write_and_rename(const fs::path &file, const std::function<void(const fs::path &)> &write)
    {
      const PartialFile partial(file);
      write(partial.path);
      FileDescriptor written(partial.path, O_WRONLY);
      written.flush_to_disk();
      written.close();
      fs::rename(partial.path, file);
      flush_folder(file.parent_path());
    }

    std::string remedy(const std::error_code &code)
    {
      return code == std::errc::no_space_on_device ? "; free some space and run again" : "";
    }

    /// Of this process, on whatever machine.
    const std::string &process_mark()
    {
      static const std::string mark = fmt::format("{}-{:08x}", ::getpid(), std::random_device()());
      return mark;
    }
  } // namespace

  fs::path temporary_name(const fs::path &final_name)
  {
    return final_name.parent_path() / fmt::format(".{}.{}.partial", final_name.filename().string(), process_mark());
  }

  void write_atomically(const fs::path &file, const std::function<void(const fs::path &)> &write)
  {
    try
    {
      write_and_rename(file, write);
    }
    catch (const std::system_error &error)
    {
      throw ComputationError(
          fmt::format("cannot write {}: {}{}", file.string(), error.code().message(), remedy(error.code())));
    }
    catch (const std::exception &error)
    {
      throw ComputationError(fmt::format("cannot write {}: {}", file.string(), error.what()));
    }
  }

  void write_text_atomically(const fs::path &file, const std::string_view text)
  {
    write_atomically(file, [&](const fs::path &partial) {
      FileDescriptor descriptor(partial, O_WRONLY | O_CREAT | O_TRUNC);
      descriptor.write(text.data(), text.size());
      descriptor.close();
    });
  }
} // namespace swimtwin
