// Where runs are added to a training: near those that its model is furthest off in.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/training/run_parameters.h>

#include <filesystem>
#include <vector>

namespace swimtwin
{
  struct AddedRun
  {
    RunParameters parameters;
    int           number = 0; ///< of its folder: no two runs of one range have the same
  };

  /// For each of the n held-out runs of the record that are furthest off, one of the range that is near to it in the
  /// groups that decide how it moves, but not the same motion: what is held out stays unseen. `taken`: not these again.
  std::vector<AddedRun> runs_near_the_worst(const TrainingRecord &record, const TrainedRange &range, int n,
                                            const std::vector<int> &taken);

  /// Those of them, complete, among the run-N of a training's folder runs/, in the order of their numbers.
  std::vector<std::filesystem::path> added_run_folders(const std::filesystem::path &runs);
} // namespace swimtwin
