// Field programs written as FieldProgram::read_csv reads them.
#pragma once

#include <datasets/field_program.h>

#include <filesystem>
#include <string>

namespace swimtwin
{
  /// The samples with 17 significant digits; `comment` becomes lines that start with #, and so does the period. Throws
  /// InputError for a field without samples.
  void write_field_program(const std::filesystem::path &file, const FieldProgram &program, const std::string &comment);
} // namespace swimtwin
