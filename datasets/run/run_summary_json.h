// summary.json: the figures of one run and where they came from.
#pragma once

#include <datasets/run/trajectory.h>
#include <datasets/system/provenance.h>

#include <filesystem>

namespace swimtwin
{
  struct RunRecord
  {
    RunSummary summary;
    Provenance provenance;
  };

  /// One key per member of RunSummary, and `provenance`. What was not computed is written as null. So is a value that
  /// is not finite, and a status of "completed" then becomes "failed: <keys> not finite". Written to a temporary name,
  /// then renamed.
  void write_run_summary_json(const std::filesystem::path &file, const RunRecord &record);
  /// null is read as not computed where that is possible, else as NaN. Throws InputError naming file and key for what
  /// is missing or of another type.
  RunRecord read_run_summary_json(const std::filesystem::path &file);
} // namespace swimtwin
