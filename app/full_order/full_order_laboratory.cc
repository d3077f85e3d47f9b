#include <app/full_order/full_order_laboratory.h>

#include <fom/step/full_order_model.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    template <int dim>
    class FullOrderLaboratorySwimmer : public LaboratorySwimmer
    {
    public:
      FullOrderLaboratorySwimmer(const Scene &scene, const FieldSignal &played, const TwinParameters &truth)
          : scene_(scene), played_(played), truth_(truth), model_(scene_, MPI_COMM_SELF),
            angle_rad_(scene.head.angle_rad)
      {
      }

      void advance(const double to_s, Chance & /*chance*/) override
      {
        const double          step = scene_.time.time_step_s();
        const Eigen::Vector2d background_T(truth_[TwinParameter::background_x].value,
                                           truth_[TwinParameter::background_y].value);
        while (model_.now().time_s + 0.5 * step < to_s)
        {
          // The implicit step reads the field at its end, and the model reads it from the scene.
          const Eigen::Vector2d b = played_.value_T(model_.now().time_s + step) + background_T;
          scene_.field            = FieldProgram::constant(b.x(), b.y());
          model_.advance();
          angle_rad_ += std::remainder(model_.now().configuration.pose.heading() - angle_rad_, 2. * std::numbers::pi);
        }
      }

      Eigen::Vector2d head_m() const override { return in_plane(model_.now().configuration.pose.center); }
      double          angle_rad() const override { return angle_rad_; }
      Eigen::Vector2d tail_point_m(const double share) const override
      {
        const auto        &swimmer = model_.swimmer();
        const unsigned int tip     = swimmer.tail().axis_at_tip[2];
        if (share != 1.)
          throw std::logic_error("a full-order laboratory shows no other point of the tail than its tip");
        return in_plane(swimmer.tail_positions(model_.now().configuration)[tip]);
      }
      double camera(const TwinParameter p) const override { return truth_[p].value; }

      std::vector<std::string> truth_names() const override
      {
        return {"x_m", "y_m", "angle_rad", "tip_x_m", "tip_y_m"};
      }
      Eigen::VectorXd truth() const override
      {
        Eigen::VectorXd values(5);
        values << head_m(), angle_rad_, tail_point_m(1.);
        return values;
      }

    private:
      static Eigen::Vector2d in_plane(const dealii::Point<dim> &x) { return {x[0], x[1]}; }

      Scene               scene_; ///< the model keeps its address
      const FieldSignal  &played_;
      TwinParameters      truth_;
      FullOrderModel<dim> model_;
      double              angle_rad_;
    };
  } // namespace

  std::unique_ptr<LaboratorySwimmer> make_full_order_laboratory_swimmer(const Scene &scene, const FieldSignal &played,
                                                                        const TwinParameters &truth)
  {
    if (scene.dimension == 3)
      return std::make_unique<FullOrderLaboratorySwimmer<3>>(scene, played, truth);
    return std::make_unique<FullOrderLaboratorySwimmer<2>>(scene, played, truth);
  }
} // namespace swimtwin
