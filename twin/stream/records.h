// What the twin says: one line of JSON per record (docs/file-formats.md, "The twin's stream").
#pragma once

#include <twin/estimate/swimmer_twin.h>
#include <twin/steering/pilot.h>
#include <twin/stream/message.h>
#include <twin/telling/telling_search.h>
#include <twin/watch/watchdog.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Of the latest frame, or predicted beyond it.
  struct EstimateRecord
  {
    double                   time_s       = 0.;
    long                     line         = 0; ///< of the input that led to it; 0: none
    bool                     is_predicted = false;
    Belief                   belief;
    std::vector<Innovation>  innovations;
    double                   significance = 1., trust = 1.;
    std::vector<std::string> flags;
  };

  struct ForecastRecord
  {
    double                                 from_s = 0.;
    std::vector<std::pair<double, Belief>> instants;
  };

  /// A parameter as people know it: E/mu and M/mu instead of logarithms; their deviations count what the model's own
  /// error leaves.
  struct NamedParameter
  {
    std::string name; ///< with its unit
    std::string units;
    double      value = 0., standard_deviation = 0.;
  };
  std::vector<NamedParameter> named_parameters(const SwimmerTwin &twin, const Belief &belief);

  std::string                  greeting_line(const SwimmerTwin &twin, const std::string &model_name);
  std::string                  estimate_line(const SwimmerTwin &twin, const EstimateRecord &record);
  std::string                  forecast_line(const SwimmerTwin &twin, const ForecastRecord &record);
  std::string                  smoothed_line(const SwimmerTwin &twin, double time_s, const Belief &belief);
  std::string                  open_line(double time_s, const std::vector<UnlearnedDirection> &directions);
  std::string                  alarm_line(const Alarm &alarm, double time_s);
  std::string                  proposal_line(const SwimmerTwin &twin, const TellingField &proposal);
  inline constexpr const char *play_line_start = R"({"type":"play",)", *alarm_line_start = R"({"type":"alarm",)",
                              *path_line_start = R"({"type":"path",)", *proposal_line_start = R"({"type":"proposal",)";
  std::string play_line(const PlayRecord &record);
  /// Where the path was laid; all that is said of it.
  std::string path_line(double time_s, const Path &path);
  /// After everything that a clock's line led to.
  std::string clock_line(double time_s);
  std::string error_line(long line, const std::string &sentence);

  /// Counts of a stream.
  struct StreamCounts
  {
    long n_lines = 0, n_frames = 0, n_late = 0, n_errors = 0, n_alarms = 0;
  };
  std::string end_line(const StreamCounts &counts);
} // namespace swimtwin
