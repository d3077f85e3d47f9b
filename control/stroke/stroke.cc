#include <control/stroke/stroke.h>

#include <control/stroke/multiplier_slopes.h>
#include <rom/sensitivity/period_start.h>
#include <rom/swimmer/area_constraint.h>
#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>

// u is what a period maps onto itself at the start, per unit, p the variables, Phi(u, p) the same one period later,
// M = Phi_u.

namespace swimtwin
{
  namespace
  {
    constexpr double negligible_multiplier = 1e-3; // its slopes would be lost in the integrator's error
    constexpr int    max_periods_waited    = 50;   // a search has no use for motions that hardly settle

    std::vector<Parameter> start_and(const std::vector<Parameter> &variables, const ReducedSwimmer &swimmer)
    {
      std::vector<Parameter> all = start_parameters(swimmer);
      all.insert(all.end(), variables.begin(), variables.end());
      return all;
    }
  } // namespace

  StrokeFinder::StrokeFinder(const ReducedSwimmer &swimmer, const StrokeOptions &options)
      : swimmer_(swimmer), options_(options), orbits_(swimmer, {.relative_tolerance = options.relative_tolerance,
                                                                .closure            = options.closure,
                                                                .max_periods        = max_periods_waited}),
        plain_(swimmer, {.relative_tolerance = options.relative_tolerance}),
        differentiated_(swimmer, {.relative_tolerance = options.relative_tolerance,
                                  .sensitivities      = start_and(options.variables, swimmer)})
  {
  }

  Stroke StrokeFinder::find(const RunRequest &request, const bool with_slopes)
  {
    Stroke stroke;
    scale_                   = start_units(swimmer_, request.drive.frequency_Hz);
    stroke.request           = request;
    stroke.request.n_periods = 1;
    stroke.orbit             = orbits_.find(request);
    stroke.n_periods         = stroke.orbit.n_periods;
    stroke.failure           = stroke.orbit.failure;
    if (!stroke.orbit.converged())
      return stroke;
    stroke.request.initial_state      = stroke.orbit.start;
    stroke.request.samples_per_period = options_.n_samples;
    const auto &multipliers           = stroke.orbit.floquet_multipliers;
    const auto  n = std::min<std::size_t>(multipliers.size(), static_cast<std::size_t>(options_.n_multipliers));
    stroke.growths.resize(static_cast<Eigen::Index>(n));
    for (std::size_t i = 0; i < n; ++i)
      stroke.growths[static_cast<Eigen::Index>(i)] = std::abs(multipliers[i]);
    SwimmerRun run = period_from(stroke.orbit.start, with_slopes ? differentiated_ : plain_, stroke);
    if (with_slopes && stroke.found())
      add_slopes(run, stroke);
    add_samples(std::move(run), stroke);
    return stroke;
  }

  SwimmerRun StrokeFinder::period_from(const SwimmerState &start, SwimmerIntegrator &integrator, Stroke &stroke) const
  {
    RunRequest request    = stroke.request;
    request.initial_state = start;
    SwimmerRun run        = integrator.run(request);
    stroke.failure        = run.failure;
    ++stroke.n_periods;
    return run;
  }

  void StrokeFinder::add_samples(SwimmerRun run, Stroke &stroke) const
  {
    if (!stroke.found())
      return;
    stroke.samples = std::move(run.snapshots);
    stroke.samples.resize(static_cast<std::size_t>(options_.n_samples));
  }

  Eigen::MatrixXd StrokeFinder::scaled(const Eigen::MatrixXd &sensitivity) const
  {
    const Eigen::Index n   = scale_.size();
    Eigen::MatrixXd    map = scale_.cwiseInverse().asDiagonal() * sensitivity.bottomRows(n);
    map.leftCols(n) *= scale_.asDiagonal();
    return map;
  }

  /// u = Phi(u, p) gives (I - M) du = Phi_p dp.
  Eigen::MatrixXd StrokeFinder::start_slopes(const Eigen::MatrixXd &map, const SwimmerState &start) const
  {
    const Eigen::Index    n = scale_.size();
    const Eigen::MatrixXd Z = free_directions(swimmer_, start);
    const Eigen::MatrixXd A = Z.transpose() * (Eigen::MatrixXd::Identity(n, n) - map.leftCols(n)) * Z;
    return Z * solve_by_qr<Eigen::MatrixXd>(A, Z.transpose() * map.rightCols(map.cols() - n));
  }

  void StrokeFinder::add_slopes(const SwimmerRun &run, Stroke &stroke)
  {
    const Eigen::Index    n = scale_.size(), m = static_cast<Eigen::Index>(options_.variables.size());
    const Eigen::MatrixXd map    = scaled(run.sensitivity_at_period_end.back());
    const Eigen::MatrixXd motion = start_slopes(map, stroke.orbit.start);
    const auto            along  = [&](const Eigen::MatrixXd &S) -> Eigen::MatrixXd {
      return S.leftCols(n) * (scale_.asDiagonal() * motion) + S.rightCols(m);
    };
    stroke.slopes.drift_m = along(run.sensitivity_at_period_end.back()).topRows(2);
    for (int i = 0; i < options_.n_samples; ++i)
      stroke.slopes.states.push_back(along(run.sensitivity_at_snapshots[static_cast<std::size_t>(i)]));
    add_growth_slopes(map.leftCols(n), motion, stroke);
  }

  /// dM r is the derivative along r of Phi_u du + Phi_p dp.
  void StrokeFinder::add_growth_slopes(const Eigen::MatrixXd &monodromy, const Eigen::MatrixXd &start_slopes,
                                       Stroke &stroke)
  {
    const auto &multipliers = stroke.orbit.floquet_multipliers;
    const auto  along       = [&](const Eigen::VectorXd &r) { return slopes_along(r, start_slopes, stroke); };
    stroke.slopes.growths   = Eigen::MatrixXd::Zero(stroke.growths.size(), start_slopes.cols());
    for (Eigen::Index k = 0; k < stroke.growths.size() && stroke.found(); ++k)
    {
      const std::complex<double> lambda = multipliers[static_cast<std::size_t>(k)];
      if (k > 0 && lambda.imag() != 0. && std::conj(lambda) == multipliers[static_cast<std::size_t>(k) - 1])
        stroke.slopes.growths.row(k) = stroke.slopes.growths.row(k - 1);
      else if (std::abs(lambda) >= negligible_multiplier)
        stroke.slopes.growths.row(k) = multiplier_slopes(monodromy, lambda, along);
    }
  }

  Eigen::MatrixXd StrokeFinder::slopes_along(const Eigen::VectorXd &direction, const Eigen::MatrixXd &start_slopes,
                                             Stroke &stroke)
  {
    constexpr std::array<std::pair<double, double>, 4> stencil = {
        {{-2., 1. / 12.}, {-1., -8. / 12.}, {1., 8. / 12.}, {2., -1. / 12.}}};
    const Eigen::Index n = scale_.size(), m = start_slopes.cols();
    Eigen::MatrixXd    slopes = Eigen::MatrixXd::Zero(n, m);
    for (const auto &[place, weight] : stencil)
    {
      SwimmerState start = stroke.orbit.start;
      start.tail(n) += place * options_.disturbance * scale_.cwiseProduct(direction);
      const SwimmerRun run = period_from(start, differentiated_, stroke);
      if (!stroke.found())
        return slopes;
      const Eigen::MatrixXd map = scaled(run.sensitivity_at_period_end.back());
      slopes += weight / options_.disturbance * (map.leftCols(n) * start_slopes + map.rightCols(m));
    }
    return slopes;
  }
} // namespace swimtwin
