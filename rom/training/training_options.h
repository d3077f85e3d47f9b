// What a training is asked for, and which scenes can be trained: known before any of it runs.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// bending: bending angles, all else relaxed; pod: displacement modes of the runs, and modes that follow them by a
  /// quadratic form; elastic: the same of the tail alone, without data.
  enum class BasisChoice { bending, pod, elastic };

  struct TrainingOptions
  {
    std::filesystem::path folder; ///< exists; nothing is written elsewhere
    std::string           command_line;
    TrainedRange          range;
    BasisChoice           basis         = BasisChoice::bending;
    int                   n_coordinates = 4, n_followers = 8;
    int                   n_samples        = 2000;  ///< of the resistance
    int                   n_held_out       = 8;     ///< full-order runs to compare with
    int                   steps_per_period = 60;    ///< of the runs that snapshots are taken from
    double                target           = 0.01;  ///< relative error of held-out displacements to be met
    double                budget_s         = 3600.; ///< CPU time of all ranks: beyond it nothing is added to the model
    double                shape_margin     = 1.15;  ///< region that is sampled over the largest shape seen
    std::vector<std::filesystem::path> snapshots;   ///< more files of the same swimmer
    std::vector<int>                   added_runs;  ///< numbers of runs that an earlier training added: not these again
    std::vector<HeldOutRun>            known_runs;  ///< compared with instead of making n_held_out runs
    /// On every rank: work done and in all, of a stage of the training.
    std::function<void(const std::string &stage, int done, int total)> on_progress;
  };

  /// Range around a scene's own values: stiffness from half to four times, frequency from an eighth to four times,
  /// magnetization from half to twice. Throws what require_trainable does.
  TrainedRange default_range(const Scene &scene);

  /// To make a model again from its scene with more snapshots: range, coordinates, samples and target as it has them,
  /// compared with the held-out runs that it knows.
  TrainingOptions options_to_refine(const ReducedModel &model);

  /// Throws InputError for a scene that the reduced swimmer cannot be: no tail, no fluid, a fixed head, gravity, walls
  /// that move, a tail that is not elastic or linear, another field than the sinusoid, in space a motion out of the
  /// plane.
  void require_trainable(const Scene &scene);
} // namespace swimtwin
