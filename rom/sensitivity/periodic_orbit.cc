#include <rom/sensitivity/period_start.h>
#include <rom/sensitivity/periodic_orbit.h>

#include <rom/swimmer/area_constraint.h>
#include <rom/swimmer/dense_algebra.h>
#include <rom/swimmer/head_frame.h>
#include <rom/swimmer/state_scale.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr double largest_step = 0.5; // of Newton's method, rad or body lengths

    double distance_from_one(const std::vector<std::complex<double>> &multipliers)
    {
      double smallest = std::numeric_limits<double>::infinity();
      for (const std::complex<double> &multiplier : multipliers)
        smallest = std::min(smallest, std::abs(multiplier - 1.));
      return smallest;
    }
  } // namespace

  bool PeriodicOrbit::is_stable() const
  {
    return std::all_of(floquet_multipliers.begin(), floquet_multipliers.end(),
                       [](const std::complex<double> &multiplier) { return std::abs(multiplier) < 1.; });
  }

  double PeriodicOrbit::displacement_m(const double heading_rad) const
  {
    return head_first(heading_rad).dot(drift_m);
  }

  Eigen::RowVectorXd PeriodicOrbit::displacement_sensitivity(const double heading_rad) const
  {
    return head_first(heading_rad).transpose() * drift_sensitivity;
  }

  PeriodicOrbitFinder::PeriodicOrbitFinder(const ReducedSwimmer &swimmer, const OrbitOptions &options)
      : swimmer_(swimmer), options_(options),
        differentiated_(swimmer, {.relative_tolerance         = options.relative_tolerance,
                                  .sensitivities              = start_parameters(swimmer),
                                  .control_sensitivity_errors = options.exact_multipliers}),
        plain_(swimmer, {.relative_tolerance = options.relative_tolerance})
  {
    std::vector<Parameter> all = start_parameters(swimmer);
    all.insert(all.end(), options.parameters.begin(), options.parameters.end());
    if (!options.parameters.empty())
      parametric_.emplace(swimmer,
                          IntegratorOptions{.relative_tolerance = options.relative_tolerance, .sensitivities = all});
  }

  Eigen::VectorXd PeriodicOrbitFinder::scaled(const SwimmerState &state) const
  {
    return state.tail(swimmer_.n_states() - 2).cwiseQuotient(units());
  }

  SwimmerState PeriodicOrbitFinder::state_of(const Eigen::VectorXd &u) const
  {
    SwimmerState state   = state_at_rest(swimmer_);
    state[1]             = height_m_;
    state.tail(u.size()) = u.cwiseProduct(units());
    return state;
  }

  Eigen::VectorXd PeriodicOrbitFinder::units() const
  {
    return start_units(swimmer_, request_.drive.frequency_Hz);
  }

  /// Velocities count as they do in the integration's tolerances.
  double PeriodicOrbitFinder::change(const Eigen::VectorXd &start, const Eigen::VectorXd &end) const
  {
    Eigen::VectorXd difference = end - start;
    difference.tail(difference.size() - 1 - swimmer_.n_modes()) /= looser_velocity;
    return difference.norm();
  }

  PeriodicOrbitFinder::PeriodMap PeriodicOrbitFinder::map(const Eigen::VectorXd &start, SwimmerIntegrator &integrator)
  {
    request_.initial_state = state_of(start);
    const SwimmerRun run   = integrator.run(request_);
    PeriodMap        period{run.completed(), run.failure, {}, {}, Eigen::Vector2d::Zero()};
    if (!run.completed())
      return period;
    period.end     = scaled(run.at_period_end.back());
    period.drift_m = run.at_period_end.back().head<2>() - request_.initial_state.head<2>();
    if (!run.sensitivity_at_period_end.empty())
    {
      const Eigen::VectorXd u = units();
      period.monodromy =
          u.cwiseInverse().asDiagonal() * run.sensitivity_at_period_end.back().bottomRows(u.size()) * u.asDiagonal();
    }
    return period;
  }

  /// Back to the area at rest.
  Eigen::VectorXd PeriodicOrbitFinder::area_correction(const Eigen::VectorXd &start) const
  {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(start.size());
    if (!swimmer_.keeps_area())
      return step;
    const ShapeVector q = state_of(start).tail(swimmer_.n_modes()), phi = swimmer_.area_gradient(q);
    step.tail(swimmer_.n_modes()) = -swimmer_.area_change(q) / phi.squaredNorm() / swimmer_.length_m() * phi;
    return step;
  }

  /// In the directions Z that keep the area, Z^T (I - M) Z s = Z^T (end - start), after the correction of the area.
  Eigen::VectorXd PeriodicOrbitFinder::newton_step(const Eigen::VectorXd &start, const PeriodMap &period) const
  {
    const Eigen::Index    n = start.size();
    const Eigen::MatrixXd Z = free_directions(swimmer_, state_of(start)), I = Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd correction = area_correction(start);
    const Eigen::VectorXd residual   = period.end - start + (period.monodromy - I) * correction;
    const Eigen::MatrixXd A          = Z.transpose() * (I - period.monodromy) * Z;
    Eigen::VectorXd       step       = Z * solve_by_qr<Eigen::VectorXd>(A, Z.transpose() * residual) + correction;
    return step * std::min(1., largest_step / step.norm());
  }

  Eigen::VectorXcd PeriodicOrbitFinder::multipliers(const Eigen::VectorXd &start, const PeriodMap &period) const
  {
    const Eigen::MatrixXd Z = free_directions(swimmer_, state_of(start));
    return complex_eigenvalues(Z.transpose() * period.monodromy * Z);
  }

  void PeriodicOrbitFinder::describe(const Eigen::VectorXd &start, const PeriodMap &period, PeriodicOrbit &orbit) const
  {
    Eigen::VectorXcd lambda = multipliers(start, period);
    std::sort(lambda.begin(), lambda.end(), [](const auto &a, const auto &b) { return std::abs(a) > std::abs(b); });
    orbit.floquet_multipliers.assign(lambda.begin(), lambda.end());
    orbit.start   = state_of(start);
    orbit.drift_m = period.drift_m;
    orbit.closure = change(start, period.end);
  }

  /// With the derivatives of the last one, if those are good enough.
  PeriodicOrbitFinder::PeriodMap PeriodicOrbitFinder::next_map(const Eigen::VectorXd &start, const PeriodMap &last,
                                                               const double last_closure, PeriodicOrbit &orbit)
  {
    constexpr double contraction = 0.2;
    ++orbit.n_periods;
    if (options_.exact_multipliers || last.monodromy.size() == 0)
      return map(start, differentiated_);
    PeriodMap period = map(start, plain_);
    if (period.completed && change(start, period.end) <= contraction * last_closure)
    {
      period.monodromy = last.monodromy;
      return period;
    }
    ++orbit.n_periods;
    return map(start, differentiated_);
  }

  /// Whether it ended at a closed orbit, which may be one of a family.
  bool PeriodicOrbitFinder::try_newton(Eigen::VectorXd start, PeriodicOrbit &orbit)
  {
    constexpr double growth   = 2.; // of the closure: Newton's method leads away
    double           smallest = std::numeric_limits<double>::infinity();
    PeriodMap        period;
    for (int i = 0; i <= options_.max_newton_steps; ++i)
    {
      period        = next_map(start, period, smallest, orbit);
      orbit.failure = period.failure;
      if (!period.completed)
        return false;
      describe(start, period, orbit);
      if (orbit.closure <= options_.closure)
        return true;
      if (orbit.closure > growth * smallest)
        return false;
      const Eigen::VectorXd step = newton_step(start, period);
      if (!step.allFinite())
        return false;
      smallest = std::min(smallest, orbit.closure);
      start += step;
      ++orbit.n_newton_steps;
    }
    return false;
  }

  /// The state after many periods, or as soon as it stays. An integration that fails ends the wait.
  Eigen::VectorXd PeriodicOrbitFinder::wait(Eigen::VectorXd start, PeriodicOrbit &orbit)
  {
    for (int i = 0; i < options_.max_periods; ++i)
    {
      const PeriodMap period = map(start, plain_);
      ++orbit.n_periods;
      if (!period.completed)
        break;
      const double way = change(start, period.end);
      start            = period.end;
      if (way <= 0.1 * options_.closure)
        break;
    }
    return start;
  }

  /// Say what was found.
  void PeriodicOrbitFinder::conclude(const bool closed, PeriodicOrbit &orbit) const
  {
    if (!orbit.failure.empty())
      orbit.status = OrbitStatus::failed;
    else if (distance_from_one(orbit.floquet_multipliers) < options_.neutral_distance)
    {
      orbit.status  = OrbitStatus::neutral_heading;
      orbit.failure = "a Floquet multiplier is 1: the heading is neutral, and no periodic motion is preferred";
    }
    else if (closed)
      orbit.status = OrbitStatus::converged;
    else
    {
      orbit.status = OrbitStatus::not_converged;
      orbit.failure =
          fmt::format("no periodic motion was found in {} periods; angle and shape still change by {:.2g} per period",
                      orbit.n_periods, orbit.closure);
    }
  }

  /// u = Phi(u, p) gives (I - M) du = dPhi/dp dp; the drift changes with the parameters p and with the motion u.
  void PeriodicOrbitFinder::add_sensitivities(PeriodicOrbit &orbit)
  {
    request_.initial_state = orbit.start;
    const SwimmerRun run   = parametric_->run(request_);
    if (!run.completed())
    {
      orbit.status  = OrbitStatus::failed;
      orbit.failure = run.failure;
      return;
    }
    const Eigen::MatrixXd &S = run.sensitivity_at_period_end.back();
    const Eigen::Index     n = swimmer_.n_states() - 2, n_parameters = S.cols() - n;
    const Eigen::MatrixXd  Z = free_directions(swimmer_, orbit.start);
    const Eigen::MatrixXd  A = Z.transpose() * (Eigen::MatrixXd::Identity(n, n) - S.bottomLeftCorner(n, n)) * Z;
    const Eigen::MatrixXd  motion =
        Z * solve_by_qr<Eigen::MatrixXd>(A, Z.transpose() * S.bottomRightCorner(n, n_parameters));
    orbit.drift_sensitivity = S.topRightCorner(2, n_parameters) + S.topLeftCorner(2, n) * motion;
  }

  PeriodicOrbit PeriodicOrbitFinder::find(const RunRequest &request)
  {
    PeriodicOrbit orbit;
    request_                     = request;
    request_.n_periods           = 1;
    request_.samples_per_period  = 0;
    height_m_                    = swimmer_.resistance().depends_on_height() ? request.initial_state[1] : 0.;
    const Eigen::VectorXd start  = scaled(request.initial_state);
    bool                  closed = try_newton(start, orbit);
    if (!closed)
      closed = try_newton(wait(start, orbit), orbit);
    conclude(closed, orbit);
    if (orbit.converged() && parametric_)
      add_sensitivities(orbit);
    return orbit;
  }
} // namespace swimtwin
