#include <control/steering/course_terms.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    double square(const double x)
    {
      return x * x;
    }
  } // namespace

  double TargetTerm::terminal(const Eigen::Ref<const Eigen::VectorXd> &state) const
  {
    return (state.head<2>() - target_m_).squaredNorm() / square(scale_m_);
  }

  void TargetTerm::add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd> &state,
                                         Eigen::Ref<Eigen::VectorXd>              by_state) const
  {
    by_state.head<2>() += 2. * (state.head<2>() - target_m_) / square(scale_m_);
  }

  double OffsetTerm::terminal(const Eigen::Ref<const Eigen::VectorXd> &state) const
  {
    return by_position_1_m_.dot(state.head<2>() - place_m_);
  }

  void OffsetTerm::add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd> & /*state*/,
                                         Eigen::Ref<Eigen::VectorXd> by_state) const
  {
    by_state.head<2>() += by_position_1_m_;
  }

  double TimedPathTerm::heading_error(const MotionInstant &instant, const PathPlace &place) const
  {
    return std::remainder(instant.state[2] - path_.direction_rad(place.arc_m) - std::numbers::pi,
                          2. * std::numbers::pi);
  }

  double TimedPathTerm::running(const MotionInstant &instant) const
  {
    const PathPlace place = path_.at(options_.speed_m_per_period * instant.phase);
    double          value = (instant.state.head<2>() - place.point_m).squaredNorm() / square(options_.distance_scale_m);
    if (options_.heading_scale_rad > 0.)
      value += square(heading_error(instant, place) / options_.heading_scale_rad);
    return value;
  }

  void TimedPathTerm::add_running_gradient(const MotionInstant &instant, InstantGradient &gradient) const
  {
    const PathPlace place = path_.at(options_.speed_m_per_period * instant.phase);
    gradient.by_state.head<2>() += 2. * (instant.state.head<2>() - place.point_m) / square(options_.distance_scale_m);
    if (options_.heading_scale_rad > 0.)
      gradient.by_state[2] += 2. * heading_error(instant, place) / square(options_.heading_scale_rad);
  }

  double CopperLossTerm::running(const MotionInstant &instant) const
  {
    return instant.field_T.squaredNorm() / square(scale_T_);
  }

  void CopperLossTerm::add_running_gradient(const MotionInstant &instant, InstantGradient &gradient) const
  {
    gradient.by_field += 2. * instant.field_T / square(scale_T_);
  }

  double WeightedCourse::terminal(const Eigen::Ref<const Eigen::VectorXd> &state) const
  {
    double value = 0.;
    for (const auto &[weight, term] : terms_)
      value += weight * term->terminal(state);
    return value;
  }

  void WeightedCourse::add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd> &state,
                                             Eigen::Ref<Eigen::VectorXd>              by_state) const
  {
    for (const auto &[weight, term] : terms_)
    {
      Eigen::VectorXd own = Eigen::VectorXd::Zero(by_state.size());
      term->add_terminal_gradient(state, own);
      by_state += weight * own;
    }
  }

  double WeightedCourse::running(const MotionInstant &instant) const
  {
    double value = 0.;
    for (const auto &[weight, term] : terms_)
      value += weight * term->running(instant);
    return value;
  }

  void WeightedCourse::add_running_gradient(const MotionInstant &instant, InstantGradient &gradient) const
  {
    for (const auto &[weight, term] : terms_)
    {
      Eigen::VectorXd by_state = Eigen::VectorXd::Zero(gradient.by_state.size());
      InstantGradient own{by_state};
      term->add_running_gradient(instant, own);
      gradient.by_state += weight * by_state;
      gradient.by_field += weight * own.by_field;
    }
  }
} // namespace swimtwin
