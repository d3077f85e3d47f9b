// The fastest way to a target: how a carrier is steered, and how fast it is played.
#pragma once

#include <control/steered_field.h>
#include <optimization/guarded_search.h>
#include <rom/adjoint_integrator.h>

namespace swimtwin
{
  struct TargetOptions
  {
    double           distance     = 0.01;      ///< body lengths: so near is the head's centre at the end
    Interval         frequency_Hz = {0.2, 3.}; ///< of the carrier
    double           max_turn_rad = 0.5;       ///< between neighbouring coefficients of the angle
    double           knot_periods = 1.;
    std::vector<int> periods      = {}; ///< to be tried; empty: some around what the carrier needs straight on
    SearchOptions    search       = {.max_evaluations = 80, .step_tolerance = 1e-6};
  };

  struct TargetWay
  {
    Minimum         minimum; ///< over (log of the frequency's ratio to the carrier's, changes of the angle)
    SteeringPlan    plan;    ///< at its frequency
    int             n_periods = 0;
    double          time_s    = 0.;
    Eigen::Vector2d end_m     = Eigen::Vector2d::Zero();

    bool found() const { return minimum.is_feasible(); }
  };

  /// Free final time through the frequency: minimise n / f for a whole number n of periods, such that the head's centre
  /// ends within the distance of the target; derivatives by the adjoint. From this state at rest or in motion. The best
  /// of the numbers of periods tried; `found` is false, and the minimum says why, where none reaches the target.
  TargetWay fastest_way(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Drive &carrier,
                        const SwimmerState &start, const Eigen::Vector2d &target_m, const TargetOptions &options = {});
} // namespace swimtwin
