// Files in an output folder that are there as a whole or not at all. Nothing of the tool is written elsewhere.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace swimtwin
{
  /// Write through a temporary file in the same folder that takes its final name only when complete and flushed to
  /// disk. `write` gets the temporary path. On any failure (a full disk too) the temporary file is removed and
  /// ComputationError names the file and the cause.
  void write_atomically(const std::filesystem::path                              &file,
                        const std::function<void(const std::filesystem::path &)> &write);
  void write_text_atomically(const std::filesystem::path &file, std::string_view text);

  /// Where this process, and no other, writes what is to become a file: hidden, beside it, and known to
  /// remove_partial_files by its form `.<name>.<process>.partial`.
  std::filesystem::path temporary_name(const std::filesystem::path &final_name);
} // namespace swimtwin
