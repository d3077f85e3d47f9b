// Points of displacement or mean speed against frequency, from a table.
#pragma once

#include <datasets/observation/observation_set.h>
#include <datasets/text/csv_table.h>
#include <datasets/tracks/data_problems.h>

namespace swimtwin
{
  /// Points (by frequency), quantity and extra columns of `set` from a table with `frequency_Hz,displacement_m,sigma_m`
  /// or `frequency_Hz,mean_speed_m_s,sigma_m_s`. Problems are noted; with an error the points stay as they are.
  void read_curve(const CsvTable &table, ObservationSet &set, DataProblems &problems);
} // namespace swimtwin
