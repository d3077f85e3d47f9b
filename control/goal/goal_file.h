// A goal written in TOML: what to reach, with which coils, and how to search.
#pragma once

#include <control/goal/field_plan.h>

#include <filesystem>

namespace swimtwin
{
  struct GoalFile
  {
    std::string      text;
    SwimmingGoal     goal;
    FieldPlanOptions options;
    double           sample_rate_Hz = 1000.; ///< of the coils
    /// A field to start from too; empty: none.
    std::filesystem::path program;
    double                program_period_s = 0.;
  };

  /// Entries that the file leaves out are the model's: swimmer, heading, trained range. Throws InputError with file,
  /// line, key, rule and remedy.
  GoalFile read_goal(const std::filesystem::path &file, const ReducedModel &model);

  /// Swimmers of the goal's calibration, evenly taken from its sample; none without one. A scale of the field is one of
  /// the magnetization. Throws InputError for a calibration without a sample.
  std::vector<SwimmerParameters> members_of(const SwimmingGoal &goal);
} // namespace swimtwin
