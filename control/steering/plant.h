// What is steered: a swimmer that answers to a field with a pose.
#pragma once

#include <control/steering/steered_field.h>
#include <rom/integration/stored_motion.h>

namespace swimtwin
{
  struct Pose
  {
    Eigen::Vector2d position_m = Eigen::Vector2d::Zero(); ///< head's centre
    double          angle_rad  = 0.;
  };

  class Plant
  {
  public:
    virtual ~Plant() = default;

    /// Play the plan between two instants (carrier periods), the first where the last call ended. Throws
    /// ComputationError.
    virtual void advance(const SteeringPlan &plan, double from, double to) = 0;
    virtual Pose pose() const                                              = 0;
  };

  /// A reduced swimmer, of other parameters perhaps than the one that plans.
  class ReducedPlant : public Plant
  {
  public:
    /// `swimmer` must live as long.
    ReducedPlant(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const SwimmerState &state,
                 double relative_tolerance = 1e-6);

    void                advance(const SteeringPlan &plan, double from, double to) override;
    Pose                pose() const override { return {state_.head<2>(), state_[2]}; }
    const SwimmerState &state() const { return state_; }

  private:
    const ReducedSwimmer &swimmer_;
    SwimmerParameters     parameters_;
    SwimmerState          state_;
    double                relative_tolerance_;
  };
} // namespace swimtwin
