// The swimmer and its slowly drifting parameters as a process that a filter follows.
#pragma once

#include <twin/filter/system.h>
#include <twin/motion/state_transition.h>
#include <twin/motion/twin_parameters.h>

namespace swimtwin
{
  /// What the reduced swimmer does not know of its own motion: standard deviations of what is added in a second.
  struct ModelNoise
  {
    double          position_m = 0., angle_rad = 0.;
    Eigen::VectorXd shape_m = {}; ///< of each mode; empty: nothing
  };

  class TwinProcess : public Process
  {
  public:
    /// `swimmer` and `field` must live as long. `nominal`: where the logarithms are 0.
    TwinProcess(const ReducedSwimmer &swimmer, const SwimmerParameters &nominal, const TwinLayout &layout,
                const FieldSignal &field, const ModelNoise &noise, double largest_step_s);

    Eigen::Index n_states() const override { return layout_.n_states(); }
    Eigen::Index n_noises() const override { return n_noises_; }
    double       largest_step_s() const override { return largest_step_s_; }
    bool         advance(double from_s, double to_s, Eigen::VectorXd &mean, Eigen::MatrixXd &transition,
                         Eigen::MatrixXd &noise) override;

    const TwinLayout     &layout() const { return layout_; }
    const ReducedSwimmer &swimmer() const { return swimmer_; }
    SwimmerParameters     parameters(const Eigen::VectorXd &state) const;
    Eigen::Vector2d       background_T(const Eigen::VectorXd &state) const;
    /// The field that the swimmer feels.
    Eigen::Vector2d field_T(double time_s, const Eigen::VectorXd &state) const;
    /// d state / dt of the swimmer in the laboratory, with the fluid's drift.
    const VelocityVector &rate(double time_s, const Eigen::VectorXd &state);

  private:
    bool go(double from_s, double to_s, Eigen::VectorXd &mean, Eigen::MatrixXd &transition, int depth);
    void set_transition(double length, Eigen::MatrixXd &transition) const;
    void set_noise(double from_s, double length, const Eigen::MatrixXd &transition, Eigen::MatrixXd &noise) const;

    const ReducedSwimmer &swimmer_;
    SwimmerParameters     nominal_;
    TwinLayout            layout_;
    const FieldSignal    &field_;
    ModelNoise            noise_;
    double                largest_step_s_;
    Eigen::Index          n_noises_;
    StateTransition       step_;
    SwimmerMotion         motion_;
    Eigen::MatrixXd       part_, product_, field_slopes_; ///< memory
  };
} // namespace swimtwin
