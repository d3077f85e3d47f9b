// Which table and which sidecar a name means.
#pragma once

#include <datasets/tracks/data_problems.h>
#include <datasets/tracks/observation_sidecar.h>

#include <filesystem>

namespace swimtwin
{
  /// Whether a name is that of a sidecar: it ends in `.toml`.
  bool is_sidecar(const std::filesystem::path &file);

  /// The sidecar of a table: `NAME.ENDING.toml` if there is one, else `NAME.toml`.
  std::filesystem::path sidecar_of(const std::filesystem::path &table);

  /// The table to read when `named` was named: the very file, or, for a sidecar, the `table` that it names or the only
  /// one beside it of its name. Empty if the recordings of the sidecar are read instead, and after an error: several
  /// tables or none, a table that the sidecar does not belong to.
  std::filesystem::path table_to_read(const std::filesystem::path &named, const ObservationSidecar &sidecar,
                                      DataProblems &problems);
} // namespace swimtwin
