// What a verb writes in its folder, as patterns of names, and what of it is there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Paths below a folder, with the shell's wildcards (`*`, `?`, `[0-9]`) within each part: "fields/tail-[0-9]*.vtu".
  using FilePatterns = std::vector<std::string>;

  /// The patterns in each folder of that pattern: "runs/run-*".
  FilePatterns below(const std::string &folder_pattern, const FilePatterns &patterns);

  FilePatterns joined(const std::vector<FilePatterns> &lists);

  /// What stands under one of the patterns and is no folder, in the order of the patterns, as paths that start
  /// with `folder`.
  std::vector<std::filesystem::path> matching_files(const std::filesystem::path &folder, const FilePatterns &patterns);

  /// Files and folders of temporary_name for one of the patterns, left by runs that were killed.
  std::vector<std::filesystem::path> partial_files(const std::filesystem::path &folder, const FilePatterns &patterns);

  /// Throws InputError where a folder stands in the place of a file, or a file in that of a folder.
  void require_places(const std::filesystem::path &folder, const FilePatterns &patterns);
} // namespace swimtwin
