// The files of a swim to a target.
#pragma once

#include <control/goal/target_goal.h>
#include <control/steering/plant.h>
#include <datasets/run/refinement.h>
#include <datasets/system/provenance.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  struct TargetInstant
  {
    double          time_s = 0.;
    Pose            pose;
    double          distance_m = 0.; ///< of the head's centre from the target
    Eigen::Vector2d field_T;
  };

  struct TargetRecord
  {
    TargetGoal                                goal;
    TargetWay                                 way;
    std::vector<TargetInstant>                swim;   ///< of the model, from rest to the end; empty without a way
    std::optional<std::vector<TargetInstant>> replay; ///< of the full-order model in the same field
    double                                    body_length_m = 0.;
    std::string                               model_file;
    std::vector<RefinementRound>              refinement; ///< of the model: each round's; or empty
    std::vector<std::string>                  warnings;
    Provenance                                provenance;

    /// "arrived", or "infeasible" where no way was found.
    std::string status() const { return way.found() ? "arrived" : "infeasible"; }
    /// One sentence: what the search says, and how near the best way comes.
    std::string message() const;
    /// Of both models' ends, relative to the way between start and end; empty without a replay.
    std::optional<double> difference_of_replay() const;
  };

  /// Play a plan from rest, and look at the plant 20 times per carrier period.
  std::vector<TargetInstant> swim_to_target(Plant &plant, const SteeringPlan &plan, int n_periods,
                                            const Eigen::Vector2d &target_m);

  void write_swim_table(const std::filesystem::path &file, const std::vector<TargetInstant> &swim);
  void write_target_summary(const std::filesystem::path &file, const TargetRecord &record);
} // namespace swimtwin
