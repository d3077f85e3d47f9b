// The inertia that a twin's or a laboratory's swimmer carries, as their files ask for it.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>
#include <datasets/text/toml_table.h>
#include <rom/swimmer/swimmer_parameters.h>

#include <string>

namespace swimtwin
{
  /// The entry `inertia` of a file: "none", "auto" (left out) or "full", which is a problem of the table where the
  /// model has none.
  std::string read_inertia(TomlTable &top, const ReducedModel &model);

  /// "auto": all of it where the model has it and the swimmer needs it at this frequency.
  InertialDensities carried_densities(const std::string &choice, const ReducedModel &model, const Scene &scene,
                                      const SwimmerParameters &swimmer, double frequency_Hz);
} // namespace swimtwin
