// The head of a swimmer, followed by a camera.
#pragma once

#include <datasets/text/csv_table.h>
#include <datasets/tracks/data_problems.h>
#include <datasets/tracks/observation_sidecar.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Positions in m at increasing times in s; the angle (rad) is empty when it was not followed.
  struct HeadTrack
  {
    double                   frequency_Hz = 0., period_start_s = 0.;
    std::vector<double>      time_s, x_m, y_m, angle_rad;
    std::string              where;      ///< file, and line of its first row
    std::vector<std::size_t> lines = {}; ///< of its rows in the file
  };

  /// Tracks of a table `time_s,x_m,y_m[,angle_rad][,frequency_Hz]`. With a recording all rows are one track of its
  /// frequency, else there is one for each value of `frequency_Hz`. Problems are noted: missing columns, cells that are
  /// not finite numbers, times that do not increase, no or too few rows. Only tracks without errors are returned.
  std::vector<HeadTrack> head_tracks(const CsvTable &table, const Recording *recording, double period_start_s,
                                     DataProblems &problems);

  /// Whether a table has the columns of a track of our own.
  bool is_track_table(const CsvTable &table);
} // namespace swimtwin
