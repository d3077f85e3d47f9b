// What the twin is to do with the swimmer: [goal] of TWIN.toml.
#pragma once

#include <control/goal/tracking_goal.h>
#include <datasets/text/toml_document.h>

#include <filesystem>

namespace swimtwin
{
  struct SteeringConfig
  {
    std::filesystem::path file; ///< of the goal
    TrackingGoal          goal;
    Eigen::Vector2d       safe_T    = Eigen::Vector2d::Zero(); ///< without sight, before and after the path
    double                latency_s = 0.; ///< from a frame's stamp to its arrival, where no clock comes with the stream
    double                valid_s   = 0.5; ///< of what is played, beyond its beginning
    double                sample_rate_Hz = 100.;
    bool                  weighs_doubt   = true; ///< the less is known of the position, the less it is acted on
  };

  /// `[goal]` of a document in `folder`. Throws InputError with file, line, key, rule and remedy.
  SteeringConfig read_steering(const TomlDocument &document, const std::filesystem::path &folder,
                               const ReducedModel &model);
} // namespace swimtwin
