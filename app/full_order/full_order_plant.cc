#include <app/full_order/full_order_plant.h>

#include <fom/step/full_order_model.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// The scene at rest, with a time grid and a field of our own.
    Scene steered_scene(Scene scene, const FullOrderPlantOptions &options)
    {
      scene.field                   = FieldProgram::constant(0., 0.);
      scene.time.period_s           = 1.;
      scene.time.steps_per_period   = static_cast<int>(std::lround(options.steps_per_second));
      scene.numerics.symmetric_half = SymmetricHalf::off; // the field at the start says nothing about what comes
      return scene;
    }

    class FullOrderPlant : public Plant
    {
    public:
      FullOrderPlant(const Scene &scene, const FullOrderPlantOptions &options)
          : options_(options), scene_(steered_scene(scene, options)), model_(scene_, MPI_COMM_SELF)
      {
      }

      void advance(const SteeringPlan &plan, double /*from*/, const double to) override
      {
        const double step = scene_.time.time_step_s(), end = to / options_.frequency_Hz;
        while (model_.now().time_s + 0.5 * step < end)
        {
          // The implicit step reads the field at its end, and the model reads it from the scene.
          const Eigen::Vector2d b = plan.field_T((model_.now().time_s + step) * options_.frequency_Hz);
          scene_.field            = FieldProgram::constant(b.x(), b.y());
          model_.advance();
        }
      }

      Pose pose() const override
      {
        const auto &pose = model_.now().configuration.pose;
        return {{pose.center[0], pose.center[1]}, pose.angle};
      }

    private:
      FullOrderPlantOptions options_;
      Scene                 scene_; ///< the model keeps its address
      FullOrderModel<2>     model_;
    };
  } // namespace

  std::unique_ptr<Plant> make_full_order_plant(const Scene &scene, const FullOrderPlantOptions &options)
  {
    return std::make_unique<FullOrderPlant>(scene, options);
  }
} // namespace swimtwin
