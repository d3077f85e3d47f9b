// Runs of the verb simulate on shipped scenes, and comparisons of what they wrote.
#pragma once

#include <tests/pipeline/child_process.h>

#include <datasets/run/run_summary_json.h>
#include <datasets/run/trajectory.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// A shipped scene (or the path of another) with entries of `--set`.
  struct ShrunkScene
  {
    std::string              name;
    std::vector<std::string> settings = {};

    ShrunkScene with(const std::vector<std::string> &more) const;
    /// Its file and `--set` for each entry.
    std::vector<std::string> arguments() const;
  };

  /// Head and tail of the reference swimmers: the length that tolerances refer to.
  constexpr double body_length_m = 8e-3;

  /// The reference swimmer of the case files on a mesh of 3,800 unknowns.
  ShrunkScene coarse_swimmer(int steps_per_period, double periods);
  /// The reference swimmer as built, in a smaller box, on a mesh of 13,000 unknowns for its half; without inertia.
  ShrunkScene coarse_swimmer_in_space(double periods);

  /// The text of a goal of `optimize` that is searched for in seconds.
  std::string brief_goal();

  struct Motion
  {
    RunSummary summary;
    Trajectory trajectory;
  };

  /// Arguments of `simulate` into a folder.
  std::vector<std::string> simulate_arguments(const ShrunkScene &scene, const std::filesystem::path &folder,
                                              const std::vector<std::string> &options = {});

  /// Simulate into a folder; the test fails if the tool does.
  Outcome simulate(const ShrunkScene &scene, const std::filesystem::path &folder,
                   const std::vector<std::string> &options = {});
  /// Simulate and read the results.
  Motion simulate(const ShrunkScene &scene);
  Motion read_motion(const std::filesystem::path &folder);

  /// Largest distance of head or tail tip between two motions, in body lengths. The second may have more rows in
  /// between: its every `stride`th row is compared.
  double distance(const Trajectory &a, const Trajectory &b, std::size_t stride = 1);
  /// The motion reflected at y = 0.
  Trajectory mirrored(Trajectory trajectory);
  double     largest_angle_difference(const Trajectory &a, const Trajectory &b);
} // namespace swimtwin
