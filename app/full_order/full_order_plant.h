// The full-order swimmer as a plant that is steered.
#pragma once

#include <control/steering/plant.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>

#include <filesystem>
#include <memory>

namespace swimtwin
{
  struct FullOrderPlantOptions
  {
    double       steps_per_second = 40.;
    double       frequency_Hz     = 0.; ///< of the plan's carrier
    bool         remembers_shapes = false;
    InertiaTerms inertia          = {}; ///< that the swimmer carries
  };

  /// If it is to remember the tail's shapes, some thirty per carrier period at most.
  class FullOrderPlant : public Plant
  {
  public:
    /// As `simulate` leaves them. Throws ComputationError.
    virtual void write_snapshots(const std::filesystem::path &file) const = 0;
  };

  /// The model's swimmer. Throws InputError in a build without the full-order model.
  std::unique_ptr<FullOrderPlant> make_full_order_plant(const ReducedModel          &model,
                                                        const FullOrderPlantOptions &options);
} // namespace swimtwin
