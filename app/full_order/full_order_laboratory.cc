#include <app/full_order/full_order_laboratory.h>
#include <app/full_order/steered_swimmer.h>

namespace swimtwin
{
  namespace
  {
    template <int dim>
    class FullOrderLaboratorySwimmer : public LaboratorySwimmer
    {
    public:
      FullOrderLaboratorySwimmer(const Scene &scene, const LabConfig &config, const FieldSignal &played)
          : played_(played), truth_(config.options.truth),
            swimmer_(steered_scene(scene, 1. / config.options.camera.frames_per_second, config.steps_per_frame))
      {
      }

      void advance(const double to_s, Chance & /*chance*/) override
      {
        const Eigen::Vector2d background_T(truth_[TwinParameter::background_x].value,
                                           truth_[TwinParameter::background_y].value);
        swimmer_.advance(
            to_s, [&](const double time_s) -> Eigen::Vector2d { return played_.value_T(time_s) + background_T; });
      }

      Eigen::Vector2d head_m() const override { return in_plane(swimmer_.center()); }
      double          angle_rad() const override { return swimmer_.angle_rad(); }
      Eigen::Vector2d tail_point_m(const double share) const override
      {
        const auto &body = swimmer_.model().swimmer();
        if (share != 1.)
          throw std::logic_error("a full-order laboratory shows no other point of the tail than its tip");
        return in_plane(body.tail_positions(swimmer_.model().now().configuration)[body.tail().axis_at_tip[2]]);
      }
      double camera(const TwinParameter p) const override { return truth_[p].value; }

      std::vector<std::string> truth_names() const override
      {
        return {"x_m", "y_m", "angle_rad", "tip_x_m", "tip_y_m"};
      }
      Eigen::VectorXd truth() const override
      {
        Eigen::VectorXd values(5);
        values << head_m(), angle_rad(), tail_point_m(1.);
        return values;
      }

    private:
      static Eigen::Vector2d in_plane(const dealii::Point<dim> &x) { return {x[0], x[1]}; }

      const FieldSignal  &played_;
      TwinParameters      truth_;
      SteeredSwimmer<dim> swimmer_;
    };
  } // namespace

  std::unique_ptr<LaboratorySwimmer> make_full_order_laboratory_swimmer(const Scene &scene, const LabConfig &config,
                                                                        const FieldSignal &played)
  {
    const Scene in_laboratory = scene_in_laboratory(scene, config);
    if (scene.dimension == 3)
      return std::make_unique<FullOrderLaboratorySwimmer<3>>(in_laboratory, config, played);
    return std::make_unique<FullOrderLaboratorySwimmer<2>>(in_laboratory, config, played);
  }
} // namespace swimtwin
