// The files of a swim along a path.
#pragma once

#include <control/goal/tracking_goal.h>
#include <datasets/files/json_entries.h>
#include <datasets/run/refinement.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace swimtwin
{
  inline constexpr const char *track_table_name = "track.csv", *track_summary_name = "track.json",
                              *track_field_name = "field.csv", *replay_table_name = "replay.csv",
                              *replay_snapshots_name = "replay-snapshots.h5";

  struct TrackRecord
  {
    TrackingGoal                 goal;
    TrackResult                  result;
    std::optional<TrackResult>   replay; ///< of a plan, played blindly on a full-order plant
    double                       body_length_m = 0.;
    std::string                  model_file;
    std::vector<RefinementRound> refinement; ///< of the model: each round's; or empty
    std::vector<std::string>     warnings;
    Provenance                   provenance;

    /// Of both models' mean positions at the end, relative to the way along the path; empty where one of them failed.
    std::optional<double> difference_of_replay() const;
  };

  /// Write what a verb's goal led to, with warnings, goal, model and provenance at the end.
  template <typename Record>
  void write_summary(const std::filesystem::path &file, Json json, const Record &record)
  {
    json["refinement"] = json_of(record.refinement);
    json["warnings"]   = record.warnings;
    json["goal"]       = record.goal.text;
    json["model_file"] = record.model_file;
    json["provenance"] = json_of(record.provenance);
    write_json_file(file, json);
  }

  /// One row per decision.
  void write_track_table(const std::filesystem::path &file, const TrackResult &result);
  /// The field as the coils play it, from rest to the end: a field program that is played once.
  void write_steered_field(const std::filesystem::path &file, const SteeringPlan &plan, double n_periods,
                           double sample_rate_Hz);
  void write_track_summary(const std::filesystem::path &file, const TrackRecord &record);
} // namespace swimtwin
