// Field programs written as FieldProgram::read_csv reads them: the samples in a table, the period in a JSON file
// beside.
#pragma once

#include <datasets/scene/field_program.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// B at instants within a period; one sample or none at all is no program that can be read, but can be written.
  struct FieldSamples
  {
    std::vector<double>                time_s;
    std::vector<std::array<double, 3>> b_T;
    double                             period_s = 0.;
  };

  /// NAME.csv, and NAME.json with the period, the SHA-256 of the table and a description. bz_T only where it is not
  /// zero.
  void write_field_samples(const std::filesystem::path &file, const FieldSamples &samples,
                           const std::string &description);
  /// Throws InputError for a field without samples.
  void write_field_program(const std::filesystem::path &file, const FieldProgram &program,
                           const std::string &description);
} // namespace swimtwin
