// What a sweep left in its folder, read back: a table of displacements, runs in folders of their own, or both.
#pragma once

#include <datasets/system/provenance.h>
#include <datasets/text/csv_table.h>
#include <reports/run/run_folder.h>
#include <reports/sweep/frequency_curves.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  struct SweepRun
  {
    std::filesystem::path folder;
    RunFolder             run; ///< its record and scene only
  };

  /// What the rows of a table come from.
  struct SweepOrigin
  {
    std::string              model_file;
    int                      n_modes = 0;
    Provenance               provenance;
    std::vector<std::string> warnings;
  };

  struct SweepFolder
  {
    std::string                name;
    std::optional<CsvTable>    table;              ///< displacement_frequency.csv
    std::size_t                n_not_computed = 0; ///< rows of the table without a displacement
    std::string                comments;           ///< of the table: the lines that start with #
    std::optional<SweepOrigin> origin;             ///< of the table, as sweep.json has it
    std::vector<SweepRun>      runs;               ///< by name
    std::vector<FrequencyCurve>
        curves; ///< of the table; without one of the completed runs, if their frequencies differ
  };

  /// Throws InputError naming the folder or file and the remedy, also when there are no results in the folder.
  SweepFolder read_sweep(const std::filesystem::path &folder);
} // namespace swimtwin
