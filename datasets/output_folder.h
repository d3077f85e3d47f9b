// The folder that a verb writes to. Nothing of the tool is written elsewhere.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  /// Write through a temporary file in the same folder that takes its final name only when complete and flushed to
  /// disk. `write` gets the temporary path. On any failure (a full disk too) the temporary file is removed and
  /// ComputationError names the file and the cause.
  void write_atomically(const std::filesystem::path                              &file,
                        const std::function<void(const std::filesystem::path &)> &write);
  void write_text_atomically(const std::filesystem::path &file, std::string_view text);

  /// Create the folder (InputError if that is impossible or it is not writable) and refuse (InputError, naming --force)
  /// if it already holds one of the named results and `force` is false.
  void prepare_output_folder(const std::filesystem::path &folder, const std::vector<std::string> &results, bool force);
} // namespace swimtwin
