#include <app/full_order/full_order_plant.h>
#include <app/full_order/steered_swimmer.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    template <int dim>
    class FullOrderPlant : public Plant
    {
    public:
      FullOrderPlant(const Scene &scene, const FullOrderPlantOptions &options)
          : options_(options),
            swimmer_(steered_scene(scene, 1., static_cast<int>(std::lround(options.steps_per_second))))
      {
      }

      void advance(const SteeringPlan &plan, double /*from*/, const double to) override
      {
        swimmer_.advance(to / options_.frequency_Hz,
                         [&](const double time_s) { return plan.field_T(time_s * options_.frequency_Hz); });
      }

      Pose pose() const override { return {{swimmer_.center()[0], swimmer_.center()[1]}, swimmer_.angle_rad()}; }

    private:
      FullOrderPlantOptions options_;
      SteeredSwimmer<dim>   swimmer_;
    };
  } // namespace

  std::unique_ptr<Plant> make_full_order_plant(const Scene &scene, const FullOrderPlantOptions &options)
  {
    if (scene.dimension == 3)
      return std::make_unique<FullOrderPlant<3>>(scene, options);
    return std::make_unique<FullOrderPlant<2>>(scene, options);
  }
} // namespace swimtwin
