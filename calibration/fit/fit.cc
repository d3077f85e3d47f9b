#include <calibration/fit/local_fit.h>
#include <calibration/fit/search_misfit.h>
#include <rom/sweep/trust.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace swimtwin
{
  namespace
  {
    void set_model_error(const FitInput &input, const Eigen::VectorXd &growth, Estimate &estimate)
    {
      estimate.error = model_error(input.reduced.record, input.problem.model_error, input.data, growth);
    }

    /// At a point, the components of the model's error at zero and the noise as stated.
    void start_at(const FitInput &input, const Eigen::VectorXd &x, Estimate &estimate)
    {
      estimate.unknowns.setZero(input.map.size() + estimate.error.n_components());
      estimate.unknowns.head(x.size()) = x;
      estimate.noise_scale             = 1.;
    }

    Estimate begin(const FitInput &input)
    {
      Estimate estimate;
      set_model_error(input, Eigen::VectorXd::Ones(input.data.n()), estimate);
      estimate.integrator_tolerance = estimate_tolerance;
      return estimate;
    }

    /// Each of these minima followed by runs until they compare.
    Estimate best_of(const FitInput &input, const std::vector<Eigen::VectorXd> &minima, Estimate estimate)
    {
      std::optional<Estimate> best;
      for (const Eigen::VectorXd &x : minima)
      {
        start_at(input, x, estimate);
        LocalFit(input, estimate).approach();
        if (!best || estimate.misfit < best->misfit)
          best = estimate;
        best->n_runs = estimate.n_runs;
      }
      return std::move(*best);
    }

    /// The best of these minima, on a table of its own. A minimum outside the search's table is a guess.
    Estimate refine(const FitInput &input, const std::vector<Eigen::VectorXd> &minima, Estimate estimate)
    {
      const double expected = estimate.search.minima[static_cast<std::size_t>(estimate.search.best)].objective;
      const bool is_known = !estimate.search.table || estimate.search.table->covers(input.map.swimmer(minima.front()));
      if (minima.size() > 1 || !is_known || size_of_residuals(input, expected) > far_residuals)
        estimate = best_of(input, minima, std::move(estimate));
      else
        start_at(input, minima.front(), estimate);
      LocalFit(input, estimate).converge();
      return estimate;
    }

    /// How many times larger than in its held-out runs the model's own indicator is here, by observation, at least 1;
    /// empty where that cannot be told.
    Eigen::VectorXd growth_of_model_error(const FitInput &input, Estimate &estimate)
    {
      const double usual   = held_out_indicator(input.reduced.record);
      const int    n_fewer = n_modes_of_comparison(input.reduced.n_modes());
      if (estimate.error.relative_size == 0. || usual == 0. || n_fewer == input.reduced.n_modes())
        return {};
      const CalibratedSwimmer swimmer = input.map.swimmer(estimate.x());
      const CalibrationModel  fewer(truncated(input.reduced, n_fewer), input.model.inertia);
      ExactDisplacements      compared(fewer, input.data.conditions,
                                       {.relative_tolerance = estimate_tolerance, .n_threads = input.n_threads});
      const Displacements    &few = compared.evaluate(swimmer, false);
      if (few.failed())
        return {};
      estimate.n_runs += compared.n_runs();
      const Eigen::VectorXd all = estimate.local->evaluate(swimmer, false).value_m;
      return (all - few.value_m).cwiseAbs().cwiseQuotient(usual * all.cwiseAbs()).cwiseMax(1.);
    }

    /// The minima of a search with another error of the model, the estimate before in the place of the one nearby.
    std::vector<Eigen::VectorXd> minima_beside(const Eigen::VectorXd &x, const Multistart &search,
                                               const Eigen::VectorXd &width)
    {
      std::vector<Eigen::VectorXd> minima{x};
      for (const Eigen::VectorXd &other : distinct_minima(search, width))
        if (!are_same(x, other, width))
          minima.push_back(other);
      return minima;
    }

    /// Least squares that an outlier leads to where the model was not trained: what that place is like says nothing of
    /// the swimmer, and must not decide how much the other observations count.
    bool is_led_astray(const FitInput &input, const Estimate &estimate)
    {
      return input.problem.loss == LossKind::least_squares && size_of_residuals(input, estimate.misfit) > far_residuals;
    }

    /// The model's error is taken to grow with its indicator; that moves the estimate, and may make another minimum the
    /// best one.
    void admit_larger_model_error(const FitInput &input, Estimate &estimate)
    {
      if (is_led_astray(input, estimate))
        return;
      const Eigen::VectorXd growth = growth_of_model_error(input, estimate);
      if (growth.size() == 0 || growth.maxCoeff() <= 1.)
        return;
      set_model_error(input, growth, estimate);
      std::vector<Eigen::VectorXd> minima{estimate.x()};
      if (estimate.search.table)
      {
        estimate.search = search_again(input, estimate.error, estimate.search);
        minima          = minima_beside(estimate.x(), estimate.search, input.map.upper() - input.map.lower());
      }
      estimate = refine(input, minima, std::move(estimate));
    }

    /// Along what no data and no prior decide, to the point nearest the nominal swimmer: one answer, not any.
    void slide_along_undecided(const FitInput &input, Estimate &estimate)
    {
      const Eigen::MatrixXd &N = estimate.information.undecided;
      if (N.cols() == 0)
        return;
      const Eigen::VectorXd x = estimate.x(), lower = input.map.lower(), upper = input.map.upper();
      const Eigen::VectorXd step  = N * (N.transpose() * (input.map.nominal() - x));
      double                share = 1.;
      for (Eigen::Index j = 0; j < x.size(); ++j)
        if (step[j] != 0.)
          share = std::min(share, std::max(0., ((step[j] > 0. ? upper[j] : lower[j]) - x[j]) / step[j]));
      estimate.unknowns.head(x.size()) += share * step;
      LocalFit(input, estimate).describe();
    }
  } // namespace

  Misfit misfit_of(const FitInput &input, const Estimate &estimate)
  {
    Misfit misfit(input.data, input.map, estimate.error, RobustLoss(input.problem.loss, input.problem.loss_width));
    misfit.noise_scale = estimate.noise_scale;
    return misfit;
  }

  LeastSquaresProblem least_squares_problem(const Misfit &misfit, DisplacementSource &source)
  {
    const Eigen::VectorXd free = Eigen::VectorXd::Constant(misfit.n_components(), std::numeric_limits<double>::max());
    LeastSquaresProblem   problem;
    problem.n_rows = misfit.n_rows();
    problem.lower.resize(misfit.n_unknowns());
    problem.upper.resize(misfit.n_unknowns());
    problem.lower << misfit.map().lower(), -free;
    problem.upper << misfit.map().upper(), free;
    problem.evaluate = [&misfit, &source](const Eigen::VectorXd &unknowns, Eigen::VectorXd &rows,
                                          Eigen::MatrixXd &by_unknowns) {
      MisfitRows result = misfit.rows(source, unknowns, true);
      if (!result.failure.empty())
        return false;
      rows        = std::move(result.rows);
      by_unknowns = std::move(result.by_unknowns);
      return true;
    };
    return problem;
  }

  Estimate fit(const FitInput &input)
  {
    Estimate estimate = begin(input);
    estimate.search   = search_bounds(input, estimate.error);
    estimate.n_runs   = estimate.search.n_runs;
    const auto minima = distinct_minima(estimate.search, input.map.upper() - input.map.lower());
    estimate          = refine(input, minima, std::move(estimate));
    admit_larger_model_error(input, estimate);
    slide_along_undecided(input, estimate);
    return estimate;
  }

  Estimate fit_near(const FitInput &input, const std::shared_ptr<DisplacementTable> &table, const Eigen::VectorXd &x)
  {
    Estimate estimate = begin(input);
    estimate.local    = table;
    start_at(input, x, estimate);
    LocalFit(input, estimate).converge_on_table();
    return estimate;
  }
} // namespace swimtwin
