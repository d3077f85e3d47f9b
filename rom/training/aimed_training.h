// Trainings one after the other, until a reduced swimmer is as accurate as was asked for.
#pragma once

#include <rom/training/training_options.h>

#include <mpi.h>

namespace swimtwin
{
  /// The best model made until one meets the target, or there is nothing left to spend or to try; its record says what
  /// was tried and why it ended. Writes runs/, held-out/, samples.h5 (samples-N-modes.h5 with modes that were added)
  /// and at last model.h5. What an interrupted training of the same scene left is used, not made again. Throws
  /// InputError for snapshots of another swimmer, ComputationError where a run fails. Collective.
  ReducedModel train(const Scene &scene, const TrainingOptions &options, MPI_Comm communicator);
} // namespace swimtwin
