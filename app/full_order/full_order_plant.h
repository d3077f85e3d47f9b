// The full-order swimmer as a plant that is steered.
#pragma once

#include <control/steering/plant.h>
#include <datasets/scene/scene.h>

#include <memory>

namespace swimtwin
{
  struct FullOrderPlantOptions
  {
    double steps_per_second = 40.;
    double frequency_Hz     = 0.; ///< of the plan's carrier
  };

  /// Throws InputError in a build without the full-order model.
  std::unique_ptr<Plant> make_full_order_plant(const Scene &scene, const FullOrderPlantOptions &options);
} // namespace swimtwin
