// The fastest way to a target: how a carrier is steered, and how fast it is played.
#pragma once

#include <control/steering/steered_field.h>
#include <optimization/guarded_search.h>
#include <rom/sensitivity/adjoint_integrator.h>

#include <limits>

namespace swimtwin
{
  struct TargetOptions
  {
    double           distance     = 0.01;      ///< body lengths: so near is the head's centre at the end
    Interval         frequency_Hz = {0.2, 3.}; ///< of the carrier
    double           time_limit_s = std::numeric_limits<double>::infinity();
    double           max_turn_rad = 1.; ///< between neighbouring coefficients of the angle
    double           knot_periods = 3.; ///< a swing of period two would be another carrier
    std::vector<int> periods      = {}; ///< to be tried; empty: some around what the carrier needs straight on
    SearchOptions    search       = {
                 .method = SearchMethod::slsqp, .max_evaluations = 100, .step_tolerance = 1e-3, .kkt_tolerance = 1e-2};
  };

  /// How far a target is off the way of a swimmer that goes on, head first (rad).
  double turn_towards(const Eigen::Vector2d &target_m, const SwimmerState &start);

  /// A carrier that is not turned.
  struct StraightSwim
  {
    double frequency_Hz = 0., advance_m = 0.; ///< head first, per period
    double speed_m_s() const { return advance_m * frequency_Hz; }
  };
  /// At the fastest of 24 frequencies with a stable motion. Throws ComputationError if it swims at none of them.
  StraightSwim fastest_straight_swim(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, Drive carrier,
                                     const Interval &frequency_Hz);

  struct TargetWay
  {
    Minimum         minimum; ///< over (log of the frequency's ratio to the carrier's, changes of the angle)
    SteeringPlan    plan;    ///< at its frequency
    int             n_periods = 0;
    double          time_s    = 0.;
    Eigen::Vector2d end_m     = Eigen::Vector2d::Zero();
    /// Of the same carrier, straight on and settled, at the frequency that makes it fastest.
    double straight_time_s = 0.;

    bool found() const { return minimum.is_feasible(); }
  };

  /// Free final time through the frequency: minimise n / f for a whole number n of periods, such that the head's centre
  /// ends within the distance of the target; derivatives by the adjoint. From this state at rest or in motion, with the
  /// carrier along its heading at first. The best of the numbers of periods tried; `found` is false, and the minimum
  /// says why, where none reaches the target.
  TargetWay fastest_way(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Drive &carrier,
                        const SwimmerState &start, const Eigen::Vector2d &target_m, const TargetOptions &options = {});
} // namespace swimtwin
