// A goal of the kind "target", written in TOML: which place to reach, with which carrier, by when.
#pragma once

#include <control/steering/target_search.h>
#include <datasets/reduced/reduced_model.h>

#include <filesystem>

namespace swimtwin
{
  struct TargetGoal
  {
    std::string       text;
    Eigen::Vector2d   target_m; ///< in the laboratory
    SwimmerState      start;    ///< at rest, as the scene places it
    Drive             carrier;
    SwimmerParameters swimmer;
    InertiaTerms      inertia; ///< that it carries
    TargetOptions     options;
    double            steps_per_second = 100.;  ///< of a replay on the full-order model
    double            sample_rate_Hz   = 1000.; ///< of the coils
  };

  /// What the file leaves out is the model's scene's. Throws InputError with file, line, key, rule and remedy; also for
  /// a target that is reached already, lies beyond a wall or too near one, asks for a heading that the model does not
  /// know, or is too far for the time limit whatever the frequency. `inertia` as in scene_with_inertia.
  TargetGoal read_target_goal(const std::filesystem::path &file, const ReducedModel &model,
                              const std::string &inertia = "");
} // namespace swimtwin
