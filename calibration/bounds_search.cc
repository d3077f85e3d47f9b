#include <calibration/bounds_search.h>
#include <calibration/search_misfit.h>
#include <datasets/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    // A few per mille of a displacement are enough to tell minima apart.
    constexpr double tolerance = 1e-5, coarse_interpolation_error = 1e-2;
    constexpr int    most_distinct = 3;

    Eigen::MatrixXd starts_of(const FitInput &input)
    {
      const int       n = input.problem.n_starts;
      Eigen::MatrixXd starts(input.map.size(), n);
      starts.col(0) = input.map.nominal();
      for (int j = 0; j < input.map.size(); ++j)
        if (const auto &given = input.map.free()[static_cast<std::size_t>(j)].start)
          starts(j, 0) = input.map.scaled(j, *given);
      if (n > 1)
        starts.rightCols(n - 1) =
            sobol_points(input.map.lower(), input.map.upper(), n - 1, static_cast<unsigned long>(input.problem.seed));
      return starts;
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
    const SearchMisfit misfit(input, error);
    long               n_runs = 0;
    const auto         table =
        tabulated_displacements(input, groups_within_bounds(input),
                                {.relative_tolerance  = tolerance,
                                 .interpolation_error = coarse_interpolation_error,
                                 .n_threads           = input.n_threads,
                                 .on_progress         = [&input](const double done) { input.show("search", done); }},
                                n_runs);
    const auto make_problem = [&] {
      std::shared_ptr<DisplacementSource> source;
      if (table)
        source = table->copy();
      else
        source = exact_displacements(input, tolerance, 1);
      return misfit.minimization_problem(source);
    };
    const Eigen::MatrixXd starts = starts_of(input);
    const Multistart      search =
        search_from_all(make_problem, starts, {.search = search_options(input.problem), .n_threads = input.n_threads});
    if (search.best < 0)
      refuse_all_starts(input, search);
    return {search, starts, table ? table->interpolation_error() : 0., n_runs};
  }

  std::vector<Eigen::VectorXd> distinct_minima(const Multistart &search, const Eigen::VectorXd &width)
  {
    constexpr double             much_worse = 20., same = 0.02; // misfit; share of the bounds' distance
    std::vector<const Minimum *> order;
    for (const Minimum &minimum : search.minima)
      if (minimum.is_feasible() && minimum.objective < 2. * search.minima[search.best].objective + much_worse)
        order.push_back(&minimum);
    std::stable_sort(order.begin(), order.end(),
                     [](const Minimum *a, const Minimum *b) { return a->objective < b->objective; });
    std::vector<Eigen::VectorXd> distinct;
    for (const Minimum *minimum : order)
      if (std::none_of(distinct.begin(), distinct.end(), [&](const Eigen::VectorXd &x) {
            return ((x - minimum->x).array() / width.array()).abs().maxCoeff() < same;
          }))
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
