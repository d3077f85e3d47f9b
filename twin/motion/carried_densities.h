// The inertia that a twin's or a laboratory's swimmer carries, as their files ask for it.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>
#include <rom/swimmer/swimmer_parameters.h>

#include <string>
#include <vector>

namespace swimtwin
{
  inline const std::vector<std::string> inertia_choices = {"none", "auto", "full"};

  /// `choice` is "none", "full", or "auto": all of it where the model has it and its scene's swimmer needs a term at
  /// this frequency.
  InertialDensities carried_densities(const std::string &choice, const ReducedModel &model, const Scene &scene,
                                      double frequency_Hz);
} // namespace swimtwin
