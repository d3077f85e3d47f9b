// A reduced swimmer from a scene, for the verb train.
#pragma once

#include <app/frame/verb.h>
#include <rom/training/training_options.h>

#include <string>
#include <vector>

namespace swimtwin
{
  struct TrainCommand
  {
    CommonOptions            common;
    TrainingOptions          training;
    std::string              frequency, young_modulus, viscosity, magnetization, bx, by; ///< ranges as typed
    std::string              basis = "bending", target = "1%", budget = "60min";
    std::vector<std::string> snapshots;
    bool                     resume = false, allow_inertia = false, has_followers = false;
  };

  /// The options of the training are complete. Collective. Throws InputError and ComputationError.
  void train_and_report(const Scene &scene, TrainCommand &command);
} // namespace swimtwin
