#include <calibration/local_fit.h>

#include <calibration/noise_level.h>
#include <calibration/search_misfit.h>
#include <datasets/error.h>
#include <rom/dense_algebra.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    // What is read off derivatives (null directions!) needs as many digits as there are.
    constexpr double information_tolerance = 1e-9, fine_interpolation_error = 1e-5;
    constexpr int    most_rounds = 4; // of moving the estimate's table to where the estimate is
    /// Of this many sigma, residuals do not come from noise.
    constexpr double far_residuals = 10.;

    // The estimate's table reaches this many standard deviations, and at least this far in a logarithm.
    constexpr double standard_deviations = 6., least_half_width = 0.03;
    /// A step of the polish below this share of a standard deviation is none.
    constexpr double settled = 0.02;
    /// Beside residuals that are larger than the stated sigma, a longer step is none either, if it gains nothing.
    constexpr double settled_cosine = 1e-3;

    /// What was computed before.
    class KnownDisplacements : public DisplacementSource
    {
    public:
      explicit KnownDisplacements(const Displacements &displacements) : displacements_(displacements) {}
      int                  n_conditions() const override { return static_cast<int>(displacements_.value_m.size()); }
      const Displacements &evaluate(const CalibratedSwimmer &, bool) override { return displacements_; }

    private:
      const Displacements &displacements_;
    };
  } // namespace

  LocalFit::LocalFit(const FitInput &input, Estimate &estimate)
      : input_(input), estimate_(estimate), groups_(input.model), lower_(input.map.lower()), upper_(input.map.upper())
  {
  }

  void LocalFit::converge()
  {
    describe();
    if (size_of_residuals() > far_residuals)
      converge_by_runs();
    if (size_of_residuals() > far_residuals)
      return;
    for (int round = 0; round < most_rounds; ++round)
    {
      input_.show("estimate", static_cast<double>(round) / most_rounds);
      make_local_table();
      polish(estimate_.unknowns);
      describe();
      const Eigen::VectorXd step = remaining_step();
      judge(step, settled);
      if (estimate_.polished)
        return;
      if (estimate_.local->covers(swimmer()))
        estimate_.unknowns += step;
      clip();
    }
  }

  /// Without a table, which reaches as far as the stated sigma lets an estimate lie: an outlier leads far beyond, and
  /// beyond, a table goes on as a plane.
  void LocalFit::converge_by_runs()
  {
    const auto source = exact_displacements(input_, information_tolerance, input_.n_threads);
    for (int round = 0; round < most_rounds; ++round)
    {
      input_.show("estimate", static_cast<double>(round) / most_rounds);
      settle(*source);
      describe();
      make_local_table();
      const double longest = estimate_.kkt_residual < settled_cosine ? settled * size_of_residuals() : settled;
      judge(remaining_step(), longest);
      if (estimate_.polished)
        break;
    }
    estimate_.n_runs += source->n_runs();
  }

  void LocalFit::converge_on_table()
  {
    polish(estimate_.unknowns);
    describe(estimate_.local->evaluate(swimmer(), true));
    judge(remaining_step(), settled);
  }

  CalibratedSwimmer LocalFit::swimmer() const
  {
    return input_.map.swimmer(estimate_.unknowns.head(input_.map.size()));
  }

  /// As wide in the groups as the information at the estimate says, within what the bounds allow.
  GroupBox LocalFit::local_box() const
  {
    GroupBox              box    = groups_within_bounds(input_);
    const Eigen::VectorXd centre = groups_.values(swimmer());
    const Eigen::MatrixXd by_x =
        groups_.slopes() * input_.map.slopes(estimate_.unknowns.head(input_.map.size())).topRows<n_motion_quantities>();
    for (Eigen::Index g = 0; g < centre.size(); ++g)
    {
      const double half =
          std::max(standard_deviations * estimate_.information.standard_deviation(by_x.row(g)), least_half_width);
      box.lower[g] = std::max(box.lower[g], centre[g] - half);
      box.upper[g] = std::min(box.upper[g], centre[g] + half);
    }
    return box;
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
  void LocalFit::polish(const Eigen::VectorXd &start)
  {
    const SearchMisfit misfit(input_, estimate_.error);
    estimate_.refined = search_minimum(misfit.minimization_problem(estimate_.local), start.head(input_.map.size()),
                                       search_options(input_.problem));
    if (estimate_.refined.is_feasible())
      estimate_.unknowns.head(input_.map.size()) = estimate_.refined.x;
    settle(*estimate_.local);
  }

  /// Least squares by displacements of `source`.
  void LocalFit::settle(DisplacementSource &source)
  {
    const FreeParameter *noise = free_noise_scale(input_.problem);
    for (int round = 0; round < (noise != nullptr ? 4 : 1); ++round)
    {
      const Misfit joint = misfit_of(input_, estimate_);
      estimate_.unknowns = solve_least_squares(least_squares_problem(joint, source), estimate_.unknowns).unknowns;
      if (noise != nullptr)
        estimate_.noise_scale = noise_scale_estimate(
            joint, estimate_.unknowns, joint.predict(source, estimate_.unknowns, true), noise->lower, noise->upper);
    }
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

  /// Polished, if the step that remains is at most `share` of a standard deviation by the stated sigma.
  void LocalFit::judge(const Eigen::VectorXd &step, const double share)
  {
    const Eigen::VectorXd of_parameters = step.head(input_.map.size());
    const double          in_deviations = (estimate_.information.whitened * of_parameters).norm();
    estimate_.polish_step               = of_parameters.lpNorm<Eigen::Infinity>();
    estimate_.polished                  = in_deviations <= share && estimate_.local->covers(swimmer());
  }

  /// In sigma, at least 1. An outlier makes residuals, and by them what the table is off by in the place of the
  /// minimum, that much larger than the stated sigma does.
  double LocalFit::size_of_residuals() const
  {
    const int n_degrees_of_freedom = std::max(1, input_.data.n() - input_.map.size());
    return std::max(1., std::sqrt(2. * estimate_.misfit / n_degrees_of_freedom));
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
    return j < lower_.size() &&
           ((estimate_.unknowns[j] <= lower_[j] && slope > 0.) || (estimate_.unknowns[j] >= upper_[j] && slope < 0.));
  }
} // namespace swimtwin
