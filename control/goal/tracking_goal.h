// A goal of the kinds "path" and "closed-loop", written in TOML: which path to swim, with which carrier, how it is led.
// The kind "target" has a reader of its own, control/goal/target_goal.h.
#pragma once

#include <control/field/field_limits.h>
#include <control/steering/closed_loop.h>
#include <datasets/reduced/reduced_model.h>

#include <filesystem>

namespace swimtwin
{
  enum class TrackingKind { path, closed_loop, target };
  enum class PlantKind {
    reduced,
    full_order,
    external ///< a laboratory: `swimtwin twin` steers it
  };
  std::string to_string(TrackingKind kind);
  std::string to_string(PlantKind kind);

  struct TrackingGoal
  {
    TrackingKind      kind = TrackingKind::path;
    std::string       text;
    Path              path = Path::line(1.); ///< in the swimmer's frame: from where it is, x ahead, y to its left
    Drive             carrier;
    FieldLimits       limits;                    ///< of the coils, the bound on the carrier's size included
    SwimmerParameters believed, true_parameters; ///< of the model that decides, and of a reduced plant
    InertiaTerms      inertia;                   ///< that both carry
    ClosedLoopOptions options;
    PlantKind         plant            = PlantKind::reduced;
    double            steps_per_second = 40.;   ///< of a full-order plant: a whole number per decision
    double            sample_rate_Hz   = 1000.; ///< of the coils
  };

  /// Whether the goal's `kind` is "target". Throws InputError for a file that cannot be read.
  bool is_target_goal(const std::filesystem::path &file);

  /// What the file leaves out is the model's scene's. Throws InputError with file, line, key, rule and remedy; also for
  /// limits that the turned carrier does not keep, for a path that leaves the domain, and for one that the swimmer
  /// cannot follow. `inertia` as in scene_with_inertia.
  TrackingGoal read_tracking_goal(const std::filesystem::path &file, const ReducedModel &model,
                                  const std::string &inertia = "");
} // namespace swimtwin
