// What a file is when it is no text, and how to make text of it.
#pragma once

#include <filesystem>
#include <string_view>

namespace swimtwin
{
  /// Throw InputError that says what the file is and how to export a table from it, if its first bytes are those of
  /// XML, a workbook, HDF5, an archive, a picture or the like, or a Git LFS pointer.
  void refuse_foreign_format(const std::filesystem::path &file, std::string_view bytes);
} // namespace swimtwin
