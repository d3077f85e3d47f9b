// Columns and units of a table of spots, by the names that trackers give them.
#pragma once

#include <datasets/tracks/data_problems.h>
#include <datasets/tracks/observation_sidecar.h>

#include <datasets/text/csv_table.h>

#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Where a table of spots holds what a track is made of. TrackMate's keys; its display names; those of trackpy (x, y,
  /// frame, particle), Manual Tracking and MTrackJ.
  struct SpotColumns
  {
    std::optional<std::size_t> x, y, time, frame, track;
  };

  SpotColumns find_spot_columns(const CsvTable &table);

  /// How trackers, and who saves their tables again, write that there is nothing.
  bool says_none(const std::string &cell);

  /// Rows of further names and of units, which hold no number: those above the first spot, and others wherever a
  /// spreadsheet has sorted them to.
  std::vector<std::size_t> further_header_rows(const CsvTable &table, const SpotColumns &columns);

  /// Metres per unit of the positions: the unit that the table says (a row of units wherever it stands, or brackets in
  /// the header), else the sidecar's `length_unit`. Noted as errors: no unit anywhere, one that is not known, two that
  /// contradict each other, pixels without `pixel_m`.
  std::optional<double> length_of_unit(const CsvTable &table, const SpotColumns &columns, const Camera &camera,
                                       DataProblems &problems);

  /// The column that tells time, and seconds per unit of it.
  struct SpotClock
  {
    std::size_t column = 0;
    double      unit_s = 0.;
  };

  /// FRAME times `frame_s` where the sidecar says it, else the time column in its unit or the sidecar's `time_unit`.
  std::optional<SpotClock> find_clock(const CsvTable &table, const SpotColumns &columns, const Camera &camera,
                                      DataProblems &problems);
} // namespace swimtwin
