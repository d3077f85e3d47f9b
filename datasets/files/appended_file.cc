#include <datasets/files/appended_file.h>
#include <datasets/files/input_file.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    [[noreturn]] void refuse_appending(const fs::path &file)
    {
      throw ComputationError(
          fmt::format("cannot write {}: {}.", file.string(), std::generic_category().message(errno)));
    }
  } // namespace

  AppendedFile::AppendedFile(const fs::path &file)
      : file_(file), descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644))
  {
    if (descriptor_ < 0)
      refuse_appending(file);
  }

  AppendedFile::~AppendedFile()
  {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }

  AppendedFile::AppendedFile(AppendedFile &&other) noexcept
      : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1))
  {
  }

  AppendedFile &AppendedFile::operator=(AppendedFile &&other) noexcept
  {
    std::swap(file_, other.file_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  void AppendedFile::append_line(std::string line)
  {
    line += '\n';
    const ssize_t n = ::write(descriptor_, line.data(), line.size());
    if (n == static_cast<ssize_t>(line.size()))
      return;
    if (n >= 0)
      errno = ENOSPC;
    refuse_appending(file_);
  }

  long cut_to_whole_lines(const fs::path &file)
  {
    std::error_code error;
    if (const auto size = fs::file_size(file, error); error || size == 0)
      return 0;
    const std::string content = read_content(file, "the file to go on with");
    const std::size_t end     = content.rfind('\n');
    fs::resize_file(file, end == std::string::npos ? 0 : end + 1, error);
    if (error)
      throw ComputationError(fmt::format("cannot shorten {}: {}.", file.string(), error.message()));
    return std::count(content.begin(), content.end(), '\n');
  }
} // namespace swimtwin
