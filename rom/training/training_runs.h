// The full-order runs that modes and the region of shapes are taken from.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/run/snapshot_set.h>
#include <datasets/scene/scene.h>
#include <rom/training/run_parameters.h>

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// A scene with other parameters.
  Scene with_parameters(const Scene &scene, const RunParameters &parameters, const std::vector<std::string> &overrides);

  /// Soft, middling and stiff tails at the lowest, a middling and the highest frequency; the soft ones in the strongest
  /// field, in which they bend most, the stiff ones in the weakest. Without inertia only E / (mu f) and M B / (mu f)
  /// matter, so this spans the range.
  std::vector<RunParameters> training_design(const TrainedRange &range);

  /// What of the scene these runs override beside their parameters.
  std::vector<std::string> training_run_overrides(int steps_per_period);

  struct TrainingRunOptions
  {
    std::filesystem::path         folder;
    std::string                   command_line;
    std::vector<std::string>      overrides;    ///< of the scene, beside the parameters
    std::function<void(int, int)> on_progress;  ///< runs done on this rank, and in all on it
    std::vector<int>              numbers = {}; ///< of the runs' folders; empty: 1, 2, ...
  };

  /// "run-07"
  std::string run_folder_name(int number);

  /// Folder of each run, complete. Runs are shared out over ranks; those that are there already are not made again.
  /// Collective.
  std::vector<std::filesystem::path> run_full_order(const Scene &scene, const std::vector<RunParameters> &runs,
                                                    const TrainingRunOptions &options, MPI_Comm communicator);
} // namespace swimtwin
