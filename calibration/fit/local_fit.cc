#include <calibration/fit/local_fit.h>

#include <calibration/fit/noise_level.h>
#include <calibration/fit/search_misfit.h>
#include <datasets/system/error.h>
#include <rom/swimmer/dense_algebra.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    // What is read off derivatives (null directions!) needs as many digits as there are.
    constexpr double information_tolerance = 1e-9, fine_interpolation_error = 1e-5;
    constexpr int    most_rounds = 4; // of moving the estimate's table to where the estimate is

    // The estimate's table reaches this many standard deviations, and at least this far in a logarithm.
    constexpr double standard_deviations = 6., least_half_width = 0.03;
    /// A step that remains below this share of a standard deviation is none; beside residuals that are far larger than
    /// the stated sigma, of one by the scatter.
    constexpr double settled = 0.02, settled_by_scatter = 0.05;
    constexpr double at_bound = 1e-9; // in a scaled variable

    // Of the trust region, in logarithms: a table of it must be cheap, and may be rough.
    constexpr int    most_approaches = 15;
    constexpr double first_radius = 0.1, largest_radius = 0.4, least_radius = 1e-3;
    constexpr double rough_interpolation_error = 1e-3;
    /// Promised decrease of the misfit that is none, and as a share of it: runs are not more exact than that.
    constexpr double no_decrease = 1e-3, no_decrease_as_share = 1e-4;
  } // namespace

  LocalFit::LocalFit(const FitInput &input, Estimate &estimate)
      : input_(input), estimate_(estimate), groups_(input.model), lower_(input.map.lower()), upper_(input.map.upper())
  {
  }

  void LocalFit::approach()
  {
    const auto exact  = exact_displacements(input_, estimate_tolerance, input_.n_threads);
    double     radius = first_radius;
    look(*exact);
    bool goes_on = true;
    for (int round = 0; goes_on && round < most_approaches && radius > least_radius; ++round)
    {
      input_.show("estimate", static_cast<double>(round) / most_approaches);
      goes_on = approach_within(radius, *exact);
    }
    estimate_.n_runs += exact->n_runs();
  }

  /// One step, and the radius of the next one. Returns whether there is more to be had: not, if the table promised next
  /// to nothing.
  bool LocalFit::approach_within(double &radius, DisplacementSource &exact)
  {
    const Eigen::VectorXd from   = estimate_.unknowns;
    const double          before = estimate_.misfit;
    estimate_.local              = rough_table(radius);
    if (!estimate_.local)
    {
      radius *= 0.25;
      return true;
    }
    look(*estimate_.local);
    const double here = estimate_.misfit;
    search_on_table();
    const bool is_cut = stay_on_table(from);
    look(*estimate_.local);
    const double promised = here - estimate_.misfit;
    look(exact);
    const double kept = before - estimate_.misfit;
    if (!(kept > 0.))
    {
      estimate_.unknowns = from;
      estimate_.misfit   = before;
    }
    if (!(kept > 0.25 * promised))
      radius *= 0.25;
    else if (kept > 0.75 * promised && is_cut)
      radius = std::min(2. * radius, largest_radius);
    return is_cut || promised > std::max(no_decrease, no_decrease_as_share * before);
  }

  /// The misfit by these displacements, infinite where they fail, with the components of the model's error that suit
  /// them.
  void LocalFit::look(DisplacementSource &source)
  {
    const Displacements &displacements = source.evaluate(swimmer(), false);
    estimate_.misfit                   = std::numeric_limits<double>::infinity();
    if (displacements.failed())
      return;
    const Misfit       misfit = misfit_of(input_, estimate_);
    KnownDisplacements known(displacements);
    estimate_.unknowns = SearchMisfit(misfit).unknowns(displacements, estimate_.unknowns.head(input_.map.size()));
    estimate_.misfit   = misfit.rows(known, estimate_.unknowns, false).misfit();
  }

  void LocalFit::converge()
  {
    describe();
    const bool is_far = size_of_residuals(input_, estimate_.misfit) > far_residuals;
    for (int round = 0; round < most_rounds; ++round)
    {
      input_.show("estimate", static_cast<double>(round) / most_rounds);
      make_local_table();
      const bool has_moved = move_if_lower(&LocalFit::move_on_table);
      judge();
      if (estimate_.polished)
        return;
      if (!is_far && move_if_lower(&LocalFit::move_by_sensitivities))
        judge();
      else if (!has_moved)
        return;
      if (estimate_.polished)
        return;
    }
  }

  void LocalFit::converge_on_table()
  {
    polish();
    describe(estimate_.local->evaluate(swimmer(), true));
    judge();
  }

  /// Whether runs find a lower misfit after the move; if not, it is undone. Misfits at another noise level do not
  /// compare.
  bool LocalFit::move_if_lower(void (LocalFit::*move)())
  {
    const Estimate   before = estimate_;
    const MisfitRows rows   = rows_;
    (this->*move)();
    describe();
    if (free_noise_scale(input_.problem) != nullptr || estimate_.misfit < before.misfit)
      return true;
    const long n_runs = estimate_.n_runs;
    estimate_         = before;
    estimate_.n_runs  = n_runs;
    rows_             = rows;
    return false;
  }

  void LocalFit::move_on_table()
  {
    const Eigen::VectorXd from = estimate_.unknowns;
    polish();
    stay_on_table(from);
  }

  void LocalFit::move_by_sensitivities()
  {
    estimate_.unknowns += remaining_step();
    clip();
  }

  CalibratedSwimmer LocalFit::swimmer() const
  {
    return input_.map.swimmer(estimate_.unknowns.head(input_.map.size()));
  }

  /// As wide in the groups as `half` says, within what the bounds allow.
  GroupBox LocalFit::box_around(const Eigen::VectorXd &half) const
  {
    GroupBox              box    = groups_within_bounds(input_);
    const Eigen::VectorXd centre = groups_.values(swimmer());
    box.lower                    = box.lower.cwiseMax(centre - half);
    box.upper                    = box.upper.cwiseMin(centre + half);
    return box;
  }

  /// As wide in the groups as the information at the estimate says.
  GroupBox LocalFit::local_box() const
  {
    const Eigen::MatrixXd by_x =
        groups_.slopes() * input_.map.slopes(estimate_.unknowns.head(input_.map.size())).topRows<n_motion_quantities>();
    Eigen::VectorXd half(groups_.size());
    for (Eigen::Index g = 0; g < half.size(); ++g)
      half[g] = std::max(standard_deviations * estimate_.information.standard_deviation(by_x.row(g)), least_half_width);
    return box_around(half);
  }

  std::shared_ptr<DisplacementTable> LocalFit::rough_table(const double radius)
  {
    return tabulated_displacements(input_, box_around(Eigen::VectorXd::Constant(groups_.size(), radius)),
                                   {.relative_tolerance  = estimate_tolerance,
                                    .interpolation_error = rough_interpolation_error,
                                    .n_threads           = input_.n_threads},
                                   estimate_.n_runs);
  }

  void LocalFit::make_local_table()
  {
    estimate_.local = tabulated_displacements(input_, local_box(),
                                              {.relative_tolerance  = estimate_tolerance,
                                               .interpolation_error = fine_interpolation_error,
                                               .n_threads           = input_.n_threads},
                                              estimate_.n_runs);
    if (!estimate_.local)
      throw ComputationError("the fit failed: the swimmer cannot be computed everywhere near the estimate; move the "
                             "bounds away from there.");
  }

  /// NLopt's answer on the table, then least squares with the model's error among the unknowns, and the noise level
  /// where it is free.
  void LocalFit::polish()
  {
    search_on_table();
    settle();
  }

  void LocalFit::search_on_table()
  {
    const SearchMisfit misfit(misfit_of(input_, estimate_));
    estimate_.refined = search_minimum(misfit.minimization_problem(estimate_.local),
                                       estimate_.unknowns.head(input_.map.size()), search_options(input_.problem));
    if (!estimate_.refined.is_feasible())
      return;
    estimate_.unknowns.head(input_.map.size()) = estimate_.refined.x;
    look(*estimate_.local);
  }

  void LocalFit::settle()
  {
    DisplacementSource  &table = *estimate_.local;
    const FreeParameter *noise = free_noise_scale(input_.problem);
    for (int round = 0; round < (noise != nullptr ? 4 : 1); ++round)
    {
      const Misfit               joint  = misfit_of(input_, estimate_);
      const double               before = joint.rows(table, estimate_.unknowns, false).misfit();
      const LeastSquaresSolution found  = solve_least_squares(least_squares_problem(joint, table), estimate_.unknowns);
      if (found.half_square < before)
        estimate_.unknowns = found.unknowns;
      if (noise != nullptr)
        estimate_.noise_scale = noise_scale_estimate(
            joint, estimate_.unknowns, joint.predict(table, estimate_.unknowns, true), noise->lower, noise->upper);
    }
  }

  /// Beyond its edge a table goes on as a plane, which large residuals would follow anywhere: no farther than the edge.
  /// Returns whether that shortened the way `from` there.
  bool LocalFit::stay_on_table(const Eigen::VectorXd &from)
  {
    if (estimate_.local->covers(swimmer()))
      return false;
    const Eigen::VectorXd step    = estimate_.unknowns - from;
    double                covered = 0.;
    for (double more = 0.5; more > 1e-6; more *= 0.5)
    {
      estimate_.unknowns = from + (covered + more) * step;
      if (estimate_.local->covers(swimmer()))
        covered += more;
    }
    estimate_.unknowns = from + covered * step;
    look(*estimate_.local);
    return true;
  }

  void LocalFit::describe()
  {
    const auto source = exact_displacements(input_, information_tolerance, input_.n_threads);
    describe(source->evaluate(swimmer(), true));
    estimate_.n_runs += source->n_runs();
  }

  void LocalFit::describe(const Displacements &displacements)
  {
    if (displacements.failed())
      throw ComputationError(fmt::format("the fit failed at its estimate: {}", displacements.failure));
    KnownDisplacements known(displacements);
    const Misfit       misfit = misfit_of(input_, estimate_);
    rows_                     = misfit.rows(known, estimate_.unknowns, true);
    estimate_.prediction      = misfit.predict(known, estimate_.unknowns, true);
    estimate_.information     = information(misfit, estimate_.unknowns, estimate_.prediction);
    estimate_.misfit          = rows_.misfit();
    set_kkt_residual();
  }

  void LocalFit::set_kkt_residual()
  {
    const double size      = std::max(1., rows_.rows.norm());
    estimate_.kkt_residual = 0.;
    for (Eigen::Index j = 0; j < rows_.by_unknowns.cols(); ++j)
    {
      const double slope = rows_.by_unknowns.col(j).dot(rows_.rows), norm = rows_.by_unknowns.col(j).norm();
      if (norm > 0. && !is_held(j, slope))
        estimate_.kkt_residual = std::max(estimate_.kkt_residual, std::abs(slope) / (norm * size));
    }
  }

  /// Polished, if the step that remains is at most a small share of a standard deviation by the scatter.
  void LocalFit::judge()
  {
    const Eigen::VectorXd of_parameters = remaining_step().head(input_.map.size());
    const double          in_deviations = (estimate_.information.whitened * of_parameters).norm();
    const double          size          = size_of_residuals(input_, estimate_.misfit);
    const double          longest       = size > far_residuals ? settled_by_scatter * size : settled;
    estimate_.polish_step               = of_parameters.lpNorm<Eigen::Infinity>();
    estimate_.polished                  = in_deviations <= longest && estimate_.local->covers(swimmer());
  }

  void LocalFit::clip()
  {
    auto x = estimate_.unknowns.head(input_.map.size());
    x      = x.cwiseMax(lower_).cwiseMin(upper_).eval();
  }

  /// Gauss and Newton's step of all unknowns by exact rows, without what is undecided or held by a bound.
  Eigen::VectorXd LocalFit::remaining_step() const
  {
    Eigen::MatrixXd       J     = rows_.by_unknowns;
    const Eigen::VectorXd slope = J.transpose() * rows_.rows;
    for (Eigen::Index j = 0; j < lower_.size(); ++j)
      if (is_held(j, slope[j]))
        J.col(j).setZero();
    return shortest_least_squares<Eigen::VectorXd>(J, -rows_.rows, null_strength);
  }

  bool LocalFit::is_held(const Eigen::Index j, const double slope) const
  {
    return j < lower_.size() && ((estimate_.unknowns[j] <= lower_[j] + at_bound && slope > 0.) ||
                                 (estimate_.unknowns[j] >= upper_[j] - at_bound && slope < 0.));
  }
} // namespace swimtwin
