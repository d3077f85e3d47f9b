// The period of a field program where the table of its samples has no place for it: NAME.json beside NAME.csv.
#pragma once

#include <filesystem>
#include <optional>

namespace swimtwin
{
  /// NAME.json for NAME.csv.
  std::filesystem::path period_file(const std::filesystem::path &program);

  /// The `period_s` of the file beside a program; none if there is no such file. Throws InputError naming it if it
  /// states no period in s, or that of another table (`table_sha256` is not the program's).
  std::optional<double> stated_period_s(const std::filesystem::path &program);
} // namespace swimtwin
