// What `optimize` leaves in its folder, and reading it back.
#pragma once

#include <datasets/run/plan_result.h>
#include <datasets/run/trajectory.h>
#include <datasets/scene/field_program.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  inline constexpr const char *plan_name = "plan.json", *field_name = "field.csv", *field_period_name = "field.json",
                              *motion_folder_name = "motion";

  /// "optimal-field" for "optimal field".
  std::string file_name(const std::string &name);
  /// In the output folder, of a field's run on the full-order model.
  std::string replay_folder_name(const std::string &field);

  /// The motion of a field over some periods, from the start of its periodic motion.
  struct PlannedMotion
  {
    std::string name; ///< of the field
    Trajectory  trajectory;
  };

  struct PlanFolder
  {
    std::string                name;
    PlanResult                 plan;
    std::vector<PlannedMotion> motions;
  };

  bool is_plan(const std::filesystem::path &folder);
  /// Throws InputError naming the file that is wrong. Motions that are not there are left out.
  PlanFolder read_plan(const std::filesystem::path &folder);
} // namespace swimtwin
