// A text file to which whole lines are appended, each by one write: it is whole at any time, but for the line that a
// kill cut short.
#pragma once

#include <filesystem>
#include <string>

namespace swimtwin
{
  class AppendedFile
  {
  public:
    AppendedFile() = default;
    /// Throws ComputationError.
    explicit AppendedFile(const std::filesystem::path &file);
    ~AppendedFile();
    AppendedFile(AppendedFile &&other) noexcept;
    AppendedFile &operator=(AppendedFile &&other) noexcept;

    /// Throws ComputationError that names the file and the cause.
    void append_line(std::string line);

  private:
    std::filesystem::path file_;
    int                   descriptor_ = -1;
  };

  /// A line that a kill cut short goes. Returns the number of whole lines; none in a file that is not there. Throws
  /// ComputationError.
  long cut_to_whole_lines(const std::filesystem::path &file);
} // namespace swimtwin
