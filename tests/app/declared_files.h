// Whether a verb leaves nothing that it does not declare.
#pragma once

#include <datasets/files/file_patterns.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace swimtwin
{
  inline void expect_all_declared(const std::filesystem::path &folder, const FilePatterns &patterns)
  {
    const std::vector<std::filesystem::path> declared = matching_files(folder, patterns);
    EXPECT_FALSE(declared.empty());
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
      EXPECT_TRUE(entry.is_directory() || std::find(declared.begin(), declared.end(), entry.path()) != declared.end())
          << entry.path() << " is written and not declared in app/frame/written_files.cc";
  }
} // namespace swimtwin
