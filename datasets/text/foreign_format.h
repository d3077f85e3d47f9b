// What stands in the place of a table, and how to make a table of it.
#pragma once

#include <filesystem>
#include <string_view>

namespace swimtwin
{
  /// Throws InputError that says what a content is and how to export a table from it: workbooks, XML of trackers, HDF5,
  /// other data formats, pictures, and what no text may be (datasets/files/input_file.h, foreign_content).
  void refuse_foreign_table(const std::filesystem::path &file, std::string_view content);
} // namespace swimtwin
