// What a motion is worth: a number made of its end and of an integral along it, with its derivatives.
#pragma once

#include <rom/swimmer/state_vectors.h>

namespace swimtwin
{
  /// An instant of a run.
  struct MotionInstant
  {
    double                            phase = 0.; ///< periods since the start
    Eigen::Ref<const Eigen::VectorXd> state;      ///< r + 3, SI
    Eigen::Vector2d                   field_T;
  };

  /// Its derivatives are added to what is there.
  struct InstantGradient
  {
    Eigen::Ref<Eigen::VectorXd> by_state;
    Eigen::Vector2d             by_field = Eigen::Vector2d::Zero();
  };

  /// J = terminal(state at the end) + integral over time (s) of running(instant). Objects are immutable.
  class MotionFunctional
  {
  public:
    virtual ~MotionFunctional() = default;

    virtual double terminal(const Eigen::Ref<const Eigen::VectorXd> & /*state*/) const { return 0.; }
    virtual void   add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd>   &/*state*/,
                                         Eigen::Ref<Eigen::VectorXd> /*by_state*/) const
    {
    }
    virtual double running(const MotionInstant & /*instant*/) const { return 0.; }
    virtual void   add_running_gradient(const MotionInstant   &/*instant*/, InstantGradient   &/*gradient*/) const {}
  };
} // namespace swimtwin
