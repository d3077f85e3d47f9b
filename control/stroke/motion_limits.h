// What a periodic motion must keep to: heading that is held, tail that is not overstrained, model that is trusted.
#pragma once

#include <control/field/field_limits.h>
#include <control/stroke/stroke.h>
#include <datasets/reduced/reduced_model.h>

namespace swimtwin
{
  /// Infinite where there is no bound.
  struct MotionLimits
  {
    double largest_multiplier    = 0.8; ///< Floquet's, in size: what a period leaves of a disturbance
    double shape_radius          = 1.;  ///< of the trained region; 1: its edge
    double angle_radius          = 1.;  ///< likewise, where the walls make the model depend on the head's angle
    double heading_deviation_rad = FieldLimits::none; ///< of the head's angle from its heading, at any instant
    /// Root mean square strain, sqrt(2 W / (E A)): W the exact elastic energy, A the tail's area.
    double tail_strain = FieldLimits::none;
  };

  /// Root mean square strain of a shape, and its derivatives by the coordinates (1/m).
  double             tail_strain(const ReducedSwimmer &swimmer, double tail_area_m2, const ShapeVector &q);
  Eigen::RowVectorXd tail_strain_slopes(const ReducedSwimmer &swimmer, double tail_area_m2, const ShapeVector &q);

  /// Bounds on a stroke, each in the form value <= 0: on the multipliers, then on the other quantities at each of its
  /// samples. Between samples they may be exceeded by what the motion turns in 1 / n_samples of a period.
  class LimitedMotion
  {
  public:
    LimitedMotion(const ReducedModel &model, const ReducedSwimmer &swimmer, const MotionLimits &limits,
                  const StrokeOptions &options, double heading_rad);

    int                             size() const { return static_cast<int>(names_.size()); }
    const std::vector<std::string> &names() const { return names_; }
    /// Slopes by the stroke's variables, if it has them.
    LimitValues evaluate(const Stroke &stroke) const;
    /// The largest value over the stroke's samples, however many it has.
    double largest_of(const Stroke &stroke) const;
    /// The largest over a stroke.
    double largest_shape_radius(const Stroke &stroke) const;
    double largest_strain(const Stroke &stroke) const;
    double largest_heading_deviation_rad(const Stroke &stroke) const;

  private:
    enum class Quantity { shape_radius, angle_radius, heading, strain };
    struct Bound
    {
      Quantity quantity;
      double   limit;
    };

    void   add_sampled(const char *name, Quantity quantity, double limit, int n_samples);
    double quantity_of(Quantity quantity, const SwimmerState &state) const;
    /// By the state, 1 x (r + 3).
    Eigen::RowVectorXd slopes_of(Quantity quantity, const SwimmerState &state) const;
    double             largest(Quantity quantity, const Stroke &stroke) const;

    const ReducedModel      &model_;
    const ReducedSwimmer    &swimmer_;
    double                   largest_multiplier_ = 0., heading_rad_ = 0., tail_area_m2_ = 0.;
    int                      n_multipliers_ = 0;
    std::vector<Bound>       bounds_;
    std::vector<std::string> names_;
  };
} // namespace swimtwin
