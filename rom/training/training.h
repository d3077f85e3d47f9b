// From a scene to a reduced swimmer: runs, modes, elasticity, resistance, and what they are worth.
#pragma once

#include <rom/training/training_options.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Writes runs/, held-out/, samples.h5 and at last model.h5. What an interrupted training of the same scene left is
  /// used, not made again. Collective.
  ReducedModel train(const Scene &scene, const TrainingOptions &options, MPI_Comm communicator);
} // namespace swimtwin
