// How well the reduced model predicts runs of the full-order model that it was not trained on.
#pragma once

#include <rom/sweep/sweep.h>
#include <rom/training/training_runs.h>

namespace swimtwin
{
  /// The model's answer for the third period from rest.
  SweepResult predict(const ReducedModel &model, const Scene &scene, const RunParameters &parameters,
                      const InertialDensities &densities = {});

  /// The model's answers to runs that are known.
  std::vector<HeldOutRun> compare_with_known(const ReducedModel &model, const Scene &scene,
                                             std::vector<HeldOutRun> runs);

  /// Full-order runs of the third period at the scene's resolution and at half as many steps, whose difference tells
  /// their error, against the model's answers. Runs that are there already are not made again. Collective.
  std::vector<HeldOutRun> compare_with_full_order(const ReducedModel &model, const Scene &scene,
                                                  const std::vector<RunParameters> &members,
                                                  const TrainingRunOptions &options, MPI_Comm communicator);

  /// The same with all of inertia on both sides, at the scene's resolution alone. Collective.
  std::vector<HeldOutRun> compare_with_inertia(const ReducedModel &model, const Scene &scene,
                                               const std::vector<RunParameters> &members,
                                               const TrainingRunOptions &options, MPI_Comm communicator);
} // namespace swimtwin
