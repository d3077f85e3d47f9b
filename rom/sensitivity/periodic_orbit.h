// The periodic motion: head's angle and shape return after a period, the head drifts.
#pragma once

#include <rom/integration/swimmer_integrator.h>

#include <complex>
#include <optional>
#include <vector>

namespace swimtwin
{
  enum class OrbitStatus {
    not_run,
    converged,       ///< by Newton's method, or by waiting
    neutral_heading, ///< a Floquet multiplier is 1: a family of periodic motions, none of them preferred
    not_converged,
    failed ///< the integrator did
  };

  struct OrbitOptions
  {
    double relative_tolerance = 1e-6; ///< of the integration
    /// On the change of state per period: angles in rad, lengths per body length.
    double closure          = 1e-5;
    int    max_newton_steps = 10;
    int    max_periods      = 200;  ///< waited for where Newton's method does not help
    double neutral_distance = 1e-4; ///< of a multiplier from 1
    /// Differentiate the map in every step. Without, its derivatives are kept while the steps still contract: faster,
    /// and the multipliers are those of a motion nearby.
    bool exact_multipliers = true;
    /// The drift's derivatives by these are wanted.
    std::vector<Parameter> parameters = {};
  };

  struct PeriodicOrbit
  {
    OrbitStatus status = OrbitStatus::not_run;
    std::string failure; ///< one sentence
    /// At phase 0, with the head's centre at the origin, or at the request's height above it where that is felt.
    SwimmerState    start;
    Eigen::Vector2d drift_m = Eigen::Vector2d::Zero(); ///< of the head's centre per period
    /// Of angle and shape (without the direction across which a closed domain keeps the area): how a disturbance grows
    /// per period. The heading's is the largest.
    std::vector<std::complex<double>> floquet_multipliers;
    /// Of the drift by the options' parameters, 2 x n_parameters, along the family of periodic motions; if converged.
    Eigen::MatrixXd drift_sensitivity;
    double          closure        = 0.; ///< change of state over the period found
    int             n_newton_steps = 0, n_periods = 0;

    bool converged() const { return status == OrbitStatus::converged; }
    bool is_stable() const;
    /// Along -(cos heading, sin heading), positive head first.
    double displacement_m(double heading_rad) const;
    /// Its derivatives by the options' parameters.
    Eigen::RowVectorXd displacement_sensitivity(double heading_rad) const;
  };

  /// Newton's method on the map of one period in (theta, q), with the integrator's sensitivities to the initial state.
  /// Position is frozen: nothing depends on the place along the domain, and the height, where walls are felt, is that
  /// of the request. One thread each, set up once.
  class PeriodicOrbitFinder
  {
  public:
    explicit PeriodicOrbitFinder(const ReducedSwimmer &swimmer, const OrbitOptions &options = {});

    /// From the request's initial state, best that of a few periods after the start.
    PeriodicOrbit find(const RunRequest &request);

  private:
    /// One period: angle, shape and velocities (in units()) at its end, and their derivatives by those at its start.
    struct PeriodMap
    {
      bool            completed = false;
      std::string     failure;
      Eigen::VectorXd end;
      Eigen::MatrixXd monodromy;
      Eigen::Vector2d drift_m;
    };

    PeriodMap       map(const Eigen::VectorXd &start, SwimmerIntegrator &integrator);
    double          change(const Eigen::VectorXd &start, const Eigen::VectorXd &end) const;
    Eigen::VectorXd scaled(const SwimmerState &state) const;
    SwimmerState    state_of(const Eigen::VectorXd &scaled) const;
    Eigen::VectorXd units() const;
    Eigen::VectorXd newton_step(const Eigen::VectorXd &start, const PeriodMap &period) const;
    PeriodMap next_map(const Eigen::VectorXd &start, const PeriodMap &last, double last_closure, PeriodicOrbit &orbit);
    Eigen::VectorXd  area_correction(const Eigen::VectorXd &start) const;
    Eigen::VectorXcd multipliers(const Eigen::VectorXd &start, const PeriodMap &period) const;
    void             describe(const Eigen::VectorXd &start, const PeriodMap &period, PeriodicOrbit &orbit) const;
    bool             try_newton(Eigen::VectorXd start, PeriodicOrbit &orbit);
    Eigen::VectorXd  wait(Eigen::VectorXd start, PeriodicOrbit &orbit);
    void             conclude(bool closed, PeriodicOrbit &orbit) const;
    void             add_sensitivities(PeriodicOrbit &orbit);

    const ReducedSwimmer            &swimmer_;
    OrbitOptions                     options_;
    SwimmerIntegrator                differentiated_, plain_;
    std::optional<SwimmerIntegrator> parametric_;
    RunRequest                       request_;
    double                           height_m_ = 0.; ///< of the head's centre at phase 0
  };
} // namespace swimtwin
