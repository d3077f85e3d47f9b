// The full-order swimmer in a field that is told step by step.
#pragma once

#include <fom/step/full_order_model.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  /// A plant's or a laboratory's. Stays where it is made: its model keeps the scene's address.
  template <int dim>
  class SteeredSwimmer
  {
  public:
    explicit SteeredSwimmer(const Scene &scene)
        : scene_(scene), model_(scene_, MPI_COMM_SELF), angle_rad_(scene.head.angle_rad)
    {
    }
    SteeredSwimmer(const SteeredSwimmer &)            = delete;
    SteeredSwimmer &operator=(const SteeredSwimmer &) = delete;

    /// Whole steps, up to the one that ends nearest to an instant; `field_T(time_s)` has two components.
    template <typename Field>
    void advance(const double to_s, const Field &field_T)
    {
      const double step = scene_.time.time_step_s();
      while (model_.now().time_s + 0.5 * step < to_s)
      {
        // The implicit step reads the field at its end, and the model reads it from the scene.
        const auto b = field_T(model_.now().time_s + step);
        scene_.field = FieldProgram::constant(b[0], b[1]);
        model_.advance();
        angle_rad_ += std::remainder(model_.now().configuration.pose.heading() - angle_rad_, 2. * std::numbers::pi);
      }
    }

    const FullOrderModel<dim> &model() const { return model_; }
    const Scene               &scene() const { return scene_; } ///< its field is that of the last step
    const dealii::Point<dim>  &center() const { return model_.now().configuration.pose.center; }
    double                     angle_rad() const { return angle_rad_; } ///< goes on beyond a turn

  private:
    Scene               scene_;
    FullOrderModel<dim> model_;
    double              angle_rad_;
  };

  /// The scene at rest with equal steps and no field yet, for such a swimmer.
  inline Scene steered_scene(Scene scene, const double period_s, const int steps_per_period)
  {
    scene.field                 = FieldProgram::constant(0., 0.);
    scene.time                  = {};
    scene.time.period_s         = period_s;
    scene.time.steps_per_period = steps_per_period;
    if (scene.dimension == 2)
      scene.numerics.symmetric_half = SymmetricHalf::off; // the field at the start says nothing about what comes
    return scene;
  }
} // namespace swimtwin
