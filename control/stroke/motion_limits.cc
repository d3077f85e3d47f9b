#include <control/stroke/motion_limits.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  double tail_strain(const ReducedSwimmer &swimmer, const double tail_area_m2, const ShapeVector &q)
  {
    return std::sqrt(2. * std::max(0., swimmer.energy().value(q)) / tail_area_m2);
  }

  Eigen::RowVectorXd tail_strain_slopes(const ReducedSwimmer &swimmer, const double tail_area_m2, const ShapeVector &q)
  {
    const double strain = tail_strain(swimmer, tail_area_m2, q);
    return swimmer.energy().gradient(q).transpose() / (std::max(strain, 1e-12) * tail_area_m2);
  }

  LimitedMotion::LimitedMotion(const ReducedModel &model, const ReducedSwimmer &swimmer, const MotionLimits &limits,
                               const StrokeOptions &options, const double heading_rad)
      : model_(model), swimmer_(swimmer), largest_multiplier_(limits.largest_multiplier), heading_rad_(heading_rad),
        tail_area_m2_(model.magnet.tail_area_m2.x()),
        n_multipliers_(std::isfinite(limits.largest_multiplier) ? options.n_multipliers : 0)
  {
    for (int k = 0; k < n_multipliers_; ++k)
      names_.push_back(fmt::format("heading held: Floquet multiplier {} <= {:.4g}", k + 1, limits.largest_multiplier));
    add_sampled("trusted shape: radius", Quantity::shape_radius, limits.shape_radius, options.n_samples);
    if (swimmer.resistance().depends_on_angle())
      add_sampled("trusted head angle: radius", Quantity::angle_radius, limits.angle_radius, options.n_samples);
    add_sampled("heading deviation (rad)", Quantity::heading, limits.heading_deviation_rad, options.n_samples);
    add_sampled("tail strain", Quantity::strain, limits.tail_strain, options.n_samples);
  }

  void LimitedMotion::add_sampled(const char *name, const Quantity quantity, const double limit, const int n_samples)
  {
    if (!std::isfinite(limit))
      return;
    bounds_.push_back({quantity, limit});
    for (int i = 0; i < n_samples; ++i)
      names_.push_back(fmt::format("{} <= {:.4g} at phase {:.3f}", name, limit, static_cast<double>(i) / n_samples));
  }

  double LimitedMotion::quantity_of(const Quantity quantity, const SwimmerState &state) const
  {
    const ShapeVector q = swimmer_.shape_of(state);
    switch (quantity)
    {
    case Quantity::shape_radius:
      return swimmer_.resistance().shape_radius(q);
    case Quantity::angle_radius:
      return std::abs(state[2]) / model_.resistance.angle_scale_rad;
    case Quantity::heading:
      return std::abs(state[2] - heading_rad_);
    case Quantity::strain:
      break;
    }
    return tail_strain(swimmer_, tail_area_m2_, q);
  }

  Eigen::RowVectorXd LimitedMotion::slopes_of(const Quantity quantity, const SwimmerState &state) const
  {
    const int          r     = swimmer_.n_modes();
    const ShapeVector  q     = swimmer_.shape_of(state);
    Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(state.size());
    switch (quantity)
    {
    case Quantity::shape_radius: {
      const Eigen::ArrayXd scale = model_.resistance.coordinate_scale_m.head(r);
      slope.segment(3, r)        = (Eigen::ArrayXd(q) / scale.square()).matrix().transpose() /
                            std::max(swimmer_.resistance().shape_radius(q), 1e-12);
      break;
    }
    case Quantity::angle_radius:
      slope[2] = std::copysign(1. / model_.resistance.angle_scale_rad, state[2]);
      break;
    case Quantity::heading:
      slope[2] = std::copysign(1., state[2] - heading_rad_);
      break;
    case Quantity::strain:
      slope.segment(3, r) = tail_strain_slopes(swimmer_, tail_area_m2_, q);
      break;
    }
    return slope;
  }

  LimitValues LimitedMotion::evaluate(const Stroke &stroke) const
  {
    const Eigen::Index n = stroke.slopes.drift_m.cols();
    LimitValues        limits{Eigen::VectorXd::Constant(size(), -1.), Eigen::MatrixXd::Zero(size(), n)};
    const Eigen::Index n_known = std::min<Eigen::Index>(n_multipliers_, stroke.growths.size());
    for (Eigen::Index k = 0; k < n_known; ++k)
    {
      limits.values[k] = stroke.growths[k] / largest_multiplier_ - 1.;
      if (n > 0)
        limits.slopes.row(k) = stroke.slopes.growths.row(k) / largest_multiplier_;
    }
    Eigen::Index row = n_multipliers_;
    for (const auto &[quantity, limit] : bounds_)
      for (std::size_t i = 0; i < stroke.samples.size(); ++i, ++row)
      {
        const SwimmerState &state = stroke.samples[i].state;
        const double        ratio = quantity_of(quantity, state) / limit;
        limits.values[row]        = ratio * ratio - 1.; // smooth where the quantity vanishes
        if (n > 0)
          limits.slopes.row(row) = 2. * ratio / limit * slopes_of(quantity, state) * stroke.slopes.states[i];
      }
    return limits;
  }

  double LimitedMotion::largest_of(const Stroke &stroke) const
  {
    double worst = -1.;
    if (n_multipliers_ > 0 && stroke.growths.size() > 0)
      worst = stroke.growths[0] / largest_multiplier_ - 1.;
    for (const auto &[quantity, limit] : bounds_)
      worst = std::max(worst, largest(quantity, stroke) / limit - 1.);
    return worst;
  }

  double LimitedMotion::largest(const Quantity quantity, const Stroke &stroke) const
  {
    double largest = 0.;
    for (const ReducedSnapshot &sample : stroke.samples)
      largest = std::max(largest, quantity_of(quantity, sample.state));
    return largest;
  }

  double LimitedMotion::largest_shape_radius(const Stroke &stroke) const
  {
    return largest(Quantity::shape_radius, stroke);
  }

  double LimitedMotion::largest_strain(const Stroke &stroke) const
  {
    return largest(Quantity::strain, stroke);
  }

  double LimitedMotion::largest_heading_deviation_rad(const Stroke &stroke) const
  {
    return largest(Quantity::heading, stroke);
  }
} // namespace swimtwin
