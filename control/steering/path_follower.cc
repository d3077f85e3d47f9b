#include <control/steering/path_follower.h>

#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  PathFollower::PathFollower(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Path &path,
                             const double advance_m, const FollowerOptions &options)
      : swimmer_(swimmer), parameters_(parameters), path_(path), advance_m_(advance_m), options_(options),
        store_(swimmer, {.relative_tolerance = options.relative_tolerance,
                         .max_step_periods   = IntegratorOptions().max_step_periods / options.horizon_periods}),
        equations_(swimmer, {})
  {
  }

  void PathFollower::Rows::add(const Eigen::RowVectorXd &row, const double value)
  {
    matrix.row(n) = row;
    residual[n++] = value;
  }

  std::vector<LinearisedInstant> PathFollower::look_ahead(const SteeringPlan &plan, const double now,
                                                          const SwimmerState &state, FollowerStep &step)
  {
    const RunRequest request{parameters_, window_of(plan, now, options_.horizon_periods), state, 1, 0};
    step.motion = store_.run(request);
    if (!step.motion.completed())
    {
      step.failure = step.motion.failure;
      return {};
    }
    equations_.start(request);
    const int           n = static_cast<int>(std::lround(options_.horizon_periods * options_.instants_per_period));
    std::vector<double> phases;
    for (int i = 1; i <= n; ++i)
      phases.push_back(static_cast<double>(i) / n);
    return linearise_motion(equations_, step.motion, phases);
  }

  /// The mean position at each instant after the first: its last period began in the past, or ahead.
  std::vector<PathFollower::MeanInstant> PathFollower::means(const std::vector<LinearisedInstant> &ahead,
                                                             const double now, const MeanPosition &record) const
  {
    const auto               per_period = static_cast<std::size_t>(options_.instants_per_period);
    const double             H          = options_.horizon_periods;
    const Eigen::Vector2d    so_far     = record.integral_at(now);
    std::vector<MeanInstant> result;
    for (std::size_t i = 1; i < ahead.size(); ++i)
    {
      const double t = now + H * ahead[i].phase;
      MeanInstant  mean{so_far + H * ahead[i].integral.head<2>(), H * ahead[i].integral_by_parameters.topRows<2>()};
      if (i <= per_period)
        mean.position_m -= record.integral_at(t - 1.);
      else
      {
        mean.position_m -= so_far + H * ahead[i - per_period].integral.head<2>();
        mean.by_angles -= H * ahead[i - per_period].integral_by_parameters.topRows<2>();
      }
      result.push_back(std::move(mean));
    }
    return result;
  }

  /// Distance from the path, and lag behind a point that moves ahead on it.
  void PathFollower::add_path_rows(const std::vector<MeanInstant> &means, double &arc_m, FollowerStep &step,
                                   Rows &rows) const
  {
    const double L = swimmer_.length_m(), share = 1. / std::sqrt(static_cast<double>(means.size()));
    const double distance_weight = share / (options_.distance_scale * L),
                 lag_weight      = share / (options_.progress_scale * L);
    const double reach = 0.5 * L, arc_now = arc_m;
    double       squares = 0.;
    for (std::size_t i = 0; i < means.size(); ++i)
    {
      const auto &[position, by_angles] = means[i];
      const PathPlace       place       = path_.nearest(position, arc_m, std::min(arc_m + reach, path_.length_m()));
      const Eigen::Vector2d miss        = position - place.point_m;
      Eigen::Matrix2d       projector   = Eigen::Matrix2d::Identity();
      if (!place.at_corner)
        projector -= place.tangent * place.tangent.transpose();
      arc_m = std::max(arc_m, place.arc_m);
      for (int k = 0; k < 2; ++k)
        rows.add(distance_weight * projector.row(k) * by_angles, distance_weight * miss[k]);
      const double goal = arc_now + 2. * advance_m_ * static_cast<double>(i + 1) / options_.instants_per_period;
      rows.add(lag_weight * place.tangent.transpose() * by_angles, lag_weight * (place.arc_m - goal));
      squares += miss.squaredNorm() / static_cast<double>(means.size());
    }
    step.predicted_rms_m = std::sqrt(squares);
    step.completed       = true;
  }

  /// Head first along the path.
  void PathFollower::add_heading_rows(const std::vector<LinearisedInstant> &ahead,
                                      const std::vector<MeanInstant> &means, const double arc_m, Rows &rows) const
  {
    if (options_.heading_scale_rad <= 0.)
      return;
    const double weight = 1. / options_.heading_scale_rad / std::sqrt(static_cast<double>(means.size()));
    for (std::size_t i = 1; i < ahead.size(); ++i)
    {
      const PathPlace place =
          path_.nearest(means[i - 1].position_m, arc_m, std::min(arc_m + 0.5 * swimmer_.length_m(), path_.length_m()));
      const double wanted = path_.direction_rad(place.arc_m) + std::numbers::pi;
      rows.add(weight * ahead[i].by_parameters.row(2),
               weight * std::remainder(ahead[i].state[2] - wanted, 2. * std::numbers::pi));
    }
  }

  /// Second differences of the angles, those before the window included.
  void PathFollower::add_turn_rows(const SteeringPlan &plan, const Eigen::Index first, Rows &rows) const
  {
    // A turn follows what is seen, and with it what is seen wrongly: doubt makes it dearer.
    constexpr double   doubt_that_matters = 0.1; // of the distance that matters
    const double       doubt = position_sd_m_ / (doubt_that_matters * options_.distance_scale * swimmer_.length_m());
    const double       scale = options_.turn_scale_rad / (1. + doubt * doubt);
    const Eigen::Index n     = rows.matrix.cols();
    for (Eigen::Index k = std::max<Eigen::Index>(first + 1, 2); k < first + n; ++k)
    {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n);
      const auto         set = [&](const Eigen::Index coefficient, const double value) {
        if (coefficient >= first)
          row[coefficient - first] = value / scale;
      };
      set(k, 1.);
      set(k - 1, -2.);
      set(k - 2, 1.);
      const Eigen::VectorXd &a = plan.angles_rad;
      rows.add(row, (a[k] - 2. * a[k - 1] + a[k - 2]) / scale);
    }
  }

  /// The Gauss-Newton step on the coefficients that are still free, within their limits; later ones go on as the last.
  void PathFollower::change(SteeringPlan &plan, const Eigen::Index first, const Eigen::Index first_free,
                            const Rows &rows) const
  {
    const Eigen::Index n = rows.matrix.cols(), n_free = first + n - first_free;
    if (n_free <= 0)
      return;
    const Eigen::MatrixXd A = rows.matrix.topRows(rows.n).rightCols(n_free);
    const Eigen::VectorXd step =
        -solve_symmetric<Eigen::VectorXd>(A.transpose() * A + 1e-6 * Eigen::MatrixXd::Identity(n_free, n_free),
                                          A.transpose() * rows.residual.head(rows.n));
    Eigen::VectorXd &a     = plan.angles_rad;
    const double     limit = options_.max_turn_rad;
    for (Eigen::Index i = 0; i < n_free; ++i)
    {
      const Eigen::Index k = first_free + i;
      a[k] += std::clamp(step[i], -options_.max_change_rad, options_.max_change_rad);
      a[k] = std::clamp(a[k], a[k - 1] - limit, a[k - 1] + limit);
    }
    const Eigen::Index last = first + n - 1;
    for (Eigen::Index k = last + 1; k < a.size(); ++k)
      a[k] = a[last] + static_cast<double>(std::min<Eigen::Index>(k - last, 4)) * (a[last] - a[last - 1]);
  }

  FollowerStep PathFollower::improve(SteeringPlan &plan, const double now, const double committed,
                                     const SwimmerState &state, const MeanPosition &record, double arc_m)
  {
    FollowerStep                         step;
    const std::vector<LinearisedInstant> ahead = look_ahead(plan, now, state, step);
    if (ahead.empty())
      return step;
    const std::vector<MeanInstant> mean  = means(ahead, now, record);
    const Eigen::Index             first = plan.first_coefficient(now);
    const Eigen::Index n = ahead.front().by_parameters.cols(), n_rows = 4 * static_cast<Eigen::Index>(mean.size()) + n;
    Rows               rows{Eigen::MatrixXd::Zero(n_rows, n), Eigen::VectorXd::Zero(n_rows)};
    const PathPlace    here =
        path_.nearest(record.mean_at(now), arc_m, std::min(arc_m + 0.5 * swimmer_.length_m(), path_.length_m()));
    step.arc_m   = std::max(arc_m, here.arc_m);
    double along = step.arc_m;
    add_path_rows(mean, along, step, rows);
    add_heading_rows(ahead, mean, step.arc_m, rows);
    add_turn_rows(plan, first, rows);
    const auto first_free =
        std::max(first, static_cast<Eigen::Index>(std::ceil(committed / plan.knot_periods - 1e-9)) + 3);
    change(plan, first, first_free, rows);
    return step;
  }
} // namespace swimtwin
