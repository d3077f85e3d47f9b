// The periodic motion in a periodic field, seen through one period, with its derivatives by the field.
#pragma once

#include <rom/sensitivity/periodic_orbit.h>

#include <string>
#include <vector>

namespace swimtwin
{
  struct StrokeOptions
  {
    double relative_tolerance = 1e-7; ///< of the integration
    double closure            = 1e-6; ///< of the periodic motion, as in OrbitOptions
    int    n_samples          = 48;   ///< instants per period at which the motion is kept
    int    n_multipliers      = 2;    ///< the largest ones whose slopes are wanted
    /// Of the motion, where multipliers are differentiated by differences of fourth order; rad or body lengths.
    double                 disturbance = 1e-2;
    std::vector<Parameter> variables   = {}; ///< to differentiate by
  };

  /// Derivatives by the options' variables, along the family of periodic motions.
  struct StrokeSlopes
  {
    Eigen::MatrixXd              drift_m; ///< 2 x n
    std::vector<Eigen::MatrixXd> states;  ///< of the samples, states x n each
    Eigen::MatrixXd              growths; ///< n_multipliers x n; zero for multipliers below 1e-3
  };

  struct Stroke
  {
    std::string                  failure = "not run"; ///< one sentence; empty if the motion was found
    RunRequest                   request;             ///< of one period, from the motion's own start
    PeriodicOrbit                orbit;
    std::vector<ReducedSnapshot> samples;       ///< at the phases i / n_samples, i < n_samples
    Eigen::VectorXd              growths;       ///< |multiplier| per period, n_multipliers, the largest first
    StrokeSlopes                 slopes;        ///< if asked for
    int                          n_periods = 0; ///< that were integrated

    bool found() const { return failure.empty(); }
  };

  /// One thread each.
  class StrokeFinder
  {
  public:
    StrokeFinder(const ReducedSwimmer &swimmer, const StrokeOptions &options);

    /// From the request's initial state, best near the motion sought.
    Stroke find(const RunRequest &request, bool with_slopes);

    const ReducedSwimmer &swimmer() const { return swimmer_; }
    const StrokeOptions  &options() const { return options_; }

  private:
    SwimmerRun period_from(const SwimmerState &start, SwimmerIntegrator &integrator, Stroke &stroke) const;
    void       add_samples(SwimmerRun run, Stroke &stroke) const;
    void       add_slopes(const SwimmerRun &run, Stroke &stroke);
    void       add_growth_slopes(const Eigen::MatrixXd &monodromy, const Eigen::MatrixXd &start_slopes, Stroke &stroke);
    /// A state's sensitivities without the rows of its position, per unit: by the start (left), by the variables.
    Eigen::MatrixXd scaled(const Eigen::MatrixXd &sensitivity) const;
    Eigen::MatrixXd start_slopes(const Eigen::MatrixXd &map, const SwimmerState &start) const;
    /// d/de of the map's slopes along start_slopes, from a start moved by e in a direction.
    Eigen::MatrixXd slopes_along(const Eigen::VectorXd &direction, const Eigen::MatrixXd &start_slopes, Stroke &stroke);

    const ReducedSwimmer &swimmer_;
    StrokeOptions         options_;
    Eigen::VectorXd       scale_; ///< of what a period maps onto itself
    PeriodicOrbitFinder   orbits_;
    SwimmerIntegrator     plain_, differentiated_;
  };
} // namespace swimtwin
