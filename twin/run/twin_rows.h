// The rows of a twin's tables: one per estimate, one per decision.
#pragma once

#include <datasets/files/hdf5_table.h>
#include <twin/run/twin_session.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// The column of twin.csv that holds words, those of watch_flags, separated by ";". All others hold numbers, or
  /// nothing where nothing is known.
  inline constexpr const char *flags_column = "flags";

  /// Of twin.csv, in its order.
  std::vector<TableColumn> estimate_columns(const TwinSession &session);
  std::string              header_of(const std::vector<TableColumn> &columns);
  std::string              estimate_row(const TwinSession &session, const EstimateRecord &record);

  inline constexpr const char *decision_header = "time_s,phase,mean_x_m,mean_y_m,path_x_m,path_y_m,arc_m,distance_m,"
                                                 "doubt_m,bx_T,by_T,took_s,decided_in_time";
  std::string                  decision_row(const PlayRecord &record);
} // namespace swimtwin
