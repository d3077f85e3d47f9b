#include <app/full_order/full_order_plant.h>

#include <fom/step/full_order_model.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    /// The scene at rest, with a time grid and a field of our own.
    Scene steered_scene(Scene scene, const FullOrderPlantOptions &options)
    {
      scene.field                 = FieldProgram::constant(0., 0.);
      scene.time.period_s         = 1.;
      scene.time.steps_per_period = static_cast<int>(std::lround(options.steps_per_second));
      if (scene.dimension == 2)
        scene.numerics.symmetric_half = SymmetricHalf::off; // the field at the start says nothing about what comes
      return scene;
    }

    template <int dim>
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
          angle_rad_ += std::remainder(model_.now().configuration.pose.heading() - angle_rad_, 2. * std::numbers::pi);
        }
      }

      Pose pose() const override
      {
        const auto &pose = model_.now().configuration.pose;
        return {{pose.center[0], pose.center[1]}, angle_rad_};
      }

    private:
      FullOrderPlantOptions options_;
      Scene                 scene_; ///< the model keeps its address
      FullOrderModel<dim>   model_;
      double                angle_rad_ = scene_.head.angle_rad;
    };
  } // namespace

  std::unique_ptr<Plant> make_full_order_plant(const Scene &scene, const FullOrderPlantOptions &options)
  {
    if (scene.dimension == 3)
      return std::make_unique<FullOrderPlant<3>>(scene, options);
    return std::make_unique<FullOrderPlant<2>>(scene, options);
  }
} // namespace swimtwin
