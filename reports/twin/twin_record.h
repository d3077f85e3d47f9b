// A twin's folder, read for its page: as much of the table as pictures can show.
#pragma once

#include <datasets/system/provenance.h>

#include <Eigen/Dense>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  struct RecordedAlarm
  {
    std::string           name, what, remedy;
    double                since_s = 0.;
    std::optional<double> until_s; ///< none: until the end, or of an instant
  };

  /// A field that would have told more of a parameter.
  struct RecordedProposal
  {
    struct Field
    {
      double frequency_Hz = 0., largest_T = 0., sd = 0., speed_m_s = 0.;
    };
    std::string          parameter;
    double               time_s = 0., ahead_s = 0.;
    Field                as_is;
    std::optional<Field> proposed; ///< none: nothing within the limits tells more
  };

  /// Columns of a table by name; NaN where a cell is empty. Of long tables every n-th row.
  using TwinColumns = std::map<std::string, std::vector<double>>;

  struct TwinParameterName
  {
    std::string column, symbol, unit; ///< of the table; as people write it
    double      factor = 1.;          ///< from the column's unit
  };

  struct TwinRecord
  {
    std::string                    name; ///< of the folder
    long                           n_rows = 0, n_steering_rows = 0;
    TwinColumns                    columns, steering; ///< the second empty without a goal
    std::vector<TwinParameterName> parameters;        ///< that were estimated
    std::vector<RecordedAlarm>     alarms;
    std::vector<RecordedProposal>  proposals;

    // Of twin.json, if the twin came to its end.
    std::optional<std::string>   status;
    std::map<std::string, long>  counts;
    std::vector<std::string>     keeps_its_prior; ///< a sentence each
    std::string                  phase;           ///< of the goal; empty: none
    double                       path_length_m = 0., arc_m = 0.;
    std::vector<Eigen::Vector2d> path_m;
    std::optional<Provenance>    provenance;

    const std::vector<double> &time_s() const { return columns.at("time_s"); }
  };

  bool is_twin(const std::filesystem::path &folder);

  /// Throws InputError with file and line for what `twin` did not write.
  TwinRecord read_twin_record(const std::filesystem::path &folder);
} // namespace swimtwin
