#include <calibration/fit/bounds_search.h>
#include <calibration/fit/search_misfit.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    // A few per mille of a displacement are enough to tell minima apart.
    constexpr double tolerance = 1e-5, coarse_interpolation_error = 1e-2;
    /// Beside an outlier a tenth of that: the differences between minima are small beside the misfit.
    constexpr double better_interpolation_error = 1e-3;
    constexpr int    most_distinct              = 3;

    constexpr int n_sampled = 500; // on a table: some milliseconds

    Eigen::VectorXd first_start(const FitInput &input)
    {
      Eigen::VectorXd start = input.map.nominal();
      for (int j = 0; j < input.map.size(); ++j)
        if (const auto &given = input.map.free()[static_cast<std::size_t>(j)].start)
          start[j] = input.map.scaled(j, *given);
      return start;
    }

    Eigen::VectorXd groups_of_first_start(const FitInput &input)
    {
      return MotionGroups(input.model).values(input.map.swimmer(first_start(input)));
    }

    std::vector<double> objectives(const MinimizationProblem &problem, const Eigen::MatrixXd &points)
    {
      std::vector<double> values;
      for (const auto &x : points.colwise())
      {
        Evaluation evaluation;
        problem.evaluate(x, false, evaluation);
        values.push_back(evaluation.failed() ? std::numeric_limits<double>::infinity() : evaluation.objective);
      }
      return values;
    }

    /// Within this share of the bounds a better point of a sample takes a point's place as a start (multi level single
    /// linkage: Rinnooy Kan and Timmer, Math. Programming 39, 1987, p. 57).
    double critical_distance(const double n_points, const double n_variables)
    {
      constexpr double sigma  = 4.;
      const double     volume = std::tgamma(1. + 0.5 * n_variables) * sigma * std::log(n_points) / n_points;
      return std::pow(volume, 1. / n_variables) / std::sqrt(std::numbers::pi);
    }

    /// The points of a sample in the order in which they make starts: those without a better one nearby, best first,
    /// then the others.
    std::vector<Eigen::Index> order_as_starts(const Eigen::MatrixXd &points, const std::vector<double> &values,
                                              const Eigen::VectorXd &width)
    {
      const auto   value    = [&](const Eigen::Index i) { return values[static_cast<std::size_t>(i)]; };
      const double distance = critical_distance(static_cast<double>(points.cols()), static_cast<double>(points.rows()));
      std::vector<Eigen::Index> order(values.size());
      std::iota(order.begin(), order.end(), 0);
      const auto leads = [&](const Eigen::Index i) {
        return std::none_of(order.begin(), order.end(), [&](const Eigen::Index k) {
          return value(k) < value(i) && (points.col(k) - points.col(i)).cwiseQuotient(width).norm() < distance;
        });
      };
      std::vector<Eigen::Index> leaders, others;
      for (const Eigen::Index i : order)
        (leads(i) ? leaders : others).push_back(i);
      std::stable_sort(leaders.begin(), leaders.end(), [&](const auto a, const auto b) { return value(a) < value(b); });
      leaders.insert(leaders.end(), others.begin(), others.end());
      return leaders;
    }

    /// As many as the problem wants, from a sample of the bounds if `problem` is cheap.
    Eigen::MatrixXd starts_of(const FitInput &input, const MinimizationProblem &problem, const bool is_cheap)
    {
      const int       n = input.problem.n_starts;
      Eigen::MatrixXd starts(input.map.size(), n);
      starts.col(0) = first_start(input);
      if (n == 1)
        return starts;
      const Eigen::MatrixXd sample =
          sobol_points(problem.lower, problem.upper, is_cheap ? std::max(n_sampled, n - 1) : n - 1,
                       static_cast<unsigned long>(input.problem.seed));
      if (!is_cheap)
        starts.rightCols(n - 1) = sample;
      else
      {
        const auto order = order_as_starts(sample, objectives(problem, sample), problem.upper - problem.lower);
        for (int i = 1; i < n; ++i)
          starts.col(i) = sample.col(order[static_cast<std::size_t>(i - 1)]);
      }
      return starts;
    }

    void tabulate(const FitInput &input, const double interpolation_error, BoundsSearch &search)
    {
      search.table =
          tabulated_displacements(input, groups_within_bounds(input),
                                  {.relative_tolerance  = tolerance,
                                   .interpolation_error = interpolation_error,
                                   .n_threads           = input.n_threads,
                                   .narrow_around       = groups_of_first_start(input),
                                   .on_progress         = [&input](const double done) { input.show("search", done); }},
                                  search.n_runs);
    }

    /// Beyond its edge the table is a guess: minima there are computed, and fail where they cannot be.
    void compute_guesses(const FitInput &input, const SearchMisfit &misfit, BoundsSearch &search)
    {
      const std::shared_ptr<ExactDisplacements> exact   = exact_displacements(input, tolerance, input.n_threads);
      const MinimizationProblem                 problem = misfit.minimization_problem(exact);
      for (Minimum &minimum : search.minima)
        if (minimum.is_feasible() && !search.table->covers(input.map.swimmer(minimum.x)))
        {
          Evaluation evaluation;
          problem.evaluate(minimum.x, false, evaluation);
          minimum.objective = evaluation.objective;
          if (evaluation.failed())
          {
            minimum.status  = MinimumStatus::failed;
            minimum.message = evaluation.failure;
          }
        }
      search.best = best_minimum(search.minima);
      search.n_runs += exact->n_runs();
    }

    [[noreturn]] void refuse_all_starts(const FitInput &input, const Multistart &search)
    {
      throw InputError(
          fmt::format("the bounds exclude every start: the swimmer could be computed at none of {} of them (the first: "
                      "{}); move the bounds of {} towards what the model was trained for.",
                      search.minima.size(), search.minima.front().message, fmt::join(input.map.names(), ", ")));
    }
  } // namespace

  BoundsSearch search_bounds(const FitInput &input, const ModelError &error)
  {
    BoundsSearch search;
    tabulate(input, coarse_interpolation_error, search);
    search = search_again(input, error, search);
    if (search.table && size_of_residuals(input, search.minima[search.best].objective) > far_residuals)
    {
      tabulate(input, better_interpolation_error, search);
      search = search_again(input, error, search);
    }
    return search;
  }

  BoundsSearch search_again(const FitInput &input, const ModelError &error, const BoundsSearch &earlier)
  {
    const SearchMisfit misfit(
        Misfit(input.data, input.map, error, RobustLoss(input.problem.loss, input.problem.loss_width)));
    const auto make_problem = [&] {
      std::shared_ptr<DisplacementSource> source;
      if (earlier.table)
        source = earlier.table->copy();
      else
        source = exact_displacements(input, tolerance, 1);
      return misfit.minimization_problem(source);
    };
    const Eigen::MatrixXd starts = starts_of(input, make_problem(), earlier.table != nullptr);
    const Multistart      search =
        search_from_all(make_problem, starts, {.search = search_options(input.problem), .n_threads = input.n_threads});
    BoundsSearch result{search, starts, earlier.table, earlier.n_runs};
    if (earlier.table)
    {
      compute_guesses(input, misfit, result);
      if (result.best < 0)
        return search_again(input, error, {{}, {}, nullptr, result.n_runs});
    }
    if (result.best < 0)
      refuse_all_starts(input, result);
    return result;
  }

  bool are_same(const Eigen::VectorXd &a, const Eigen::VectorXd &b, const Eigen::VectorXd &width)
  {
    constexpr double same = 0.02; // share of the bounds' distance
    return ((a - b).array() / width.array()).abs().maxCoeff() < same;
  }

  std::vector<Eigen::VectorXd> distinct_minima(const Multistart &search, const Eigen::VectorXd &width)
  {
    constexpr double             much_worse = 20.; // misfit
    std::vector<const Minimum *> order;
    for (const Minimum &minimum : search.minima)
      if (minimum.is_feasible() && minimum.objective < 2. * search.minima[search.best].objective + much_worse)
        order.push_back(&minimum);
    std::stable_sort(order.begin(), order.end(),
                     [](const Minimum *a, const Minimum *b) { return a->objective < b->objective; });
    std::vector<Eigen::VectorXd> distinct;
    for (const Minimum *minimum : order)
      if (std::none_of(distinct.begin(), distinct.end(),
                       [&](const Eigen::VectorXd &x) { return are_same(x, minimum->x, width); }))
        distinct.push_back(minimum->x);
    distinct.resize(std::min<std::size_t>(distinct.size(), most_distinct));
    return distinct;
  }

  std::vector<FitStart> waterfall(const FitInput &input, const BoundsSearch &search)
  {
    std::vector<FitStart> starts;
    for (std::size_t i = 0; i < search.minima.size(); ++i)
    {
      const Minimum &minimum = search.minima[i];
      FitStart       start;
      start.start = input.map.values(search.starts.col(static_cast<Eigen::Index>(i)));
      start.end   = minimum.x.size() > 0 ? input.map.values(minimum.x) : start.start;
      start.misfit_at_start =
          minimum.trace.empty() ? std::numeric_limits<double>::quiet_NaN() : minimum.trace.front().objective;
      start.misfit        = minimum.is_feasible() ? minimum.objective : std::numeric_limits<double>::quiet_NaN();
      start.status        = to_string(minimum.status);
      start.kkt_residual  = minimum.kkt_residual;
      start.n_evaluations = minimum.n_evaluations;
      starts.push_back(start);
    }
    std::stable_sort(starts.begin(), starts.end(), [](const FitStart &a, const FitStart &b) {
      return a.misfit < b.misfit || (std::isfinite(a.misfit) && !std::isfinite(b.misfit));
    });
    return starts;
  }
} // namespace swimtwin
