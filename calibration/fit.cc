#include <calibration/fit.h>
#include <datasets/error.h>
#include <rom/trust.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr double search_tolerance = 1e-6, exact_tolerance = 1e-7, information_tolerance = 1e-9;
    constexpr int    most_refined = 3; // minima of the table that are searched again

    /// Misfit for the search: the model's error only makes observations less sure, each by itself.
    struct SearchMisfit
    {
      SearchMisfit(const FitInput &input, const ModelError &error)
          : none{0., error.decades, "none", {}, Eigen::MatrixXd(input.data.n(), 0)},
            misfit(input.data, input.map, none, RobustLoss(input.problem.loss, input.problem.loss_width))
      {
        const Eigen::VectorXd of_model = error.size.cwiseProduct(input.data.observed_m);
        misfit.sigma_m                 = (misfit.sigma_m.cwiseAbs2() + of_model.cwiseAbs2()).cwiseSqrt();
      }
      SearchMisfit(const SearchMisfit &)            = delete;
      SearchMisfit &operator=(const SearchMisfit &) = delete;

      ModelError none;
      Misfit     misfit;
    };

    MinimizationProblem minimization_problem(const Misfit &misfit, std::shared_ptr<DisplacementSource> source)
    {
      MinimizationProblem problem;
      problem.lower    = misfit.map().lower();
      problem.upper    = misfit.map().upper();
      problem.evaluate = [&misfit, source = std::move(source)](const Eigen::VectorXd &x, const bool derivatives,
                                                               Evaluation &evaluation) {
        const MisfitRows rows = misfit.rows(*source, x, derivatives);
        evaluation.failure    = rows.failure;
        if (evaluation.failed())
          return;
        evaluation.objective = rows.misfit();
        if (derivatives)
          evaluation.gradient = rows.by_unknowns.transpose() * rows.rows;
      };
      return problem;
    }

    /// The problem's own start, or the nominal swimmer, then points that fill the bounds.
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

    /// Minima that are not the same one again, best first, of about the best one's misfit.
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
      distinct.resize(std::min<std::size_t>(distinct.size(), most_refined));
      return distinct;
    }

    [[noreturn]] void refuse_all_starts(const FitInput &input, const Multistart &search)
    {
      throw InputError(
          fmt::format("the bounds exclude every start: the swimmer could be computed at none of {} of them (the first: "
                      "{}); move the bounds of {} towards what the model was trained for.",
                      search.minima.size(), search.minima.front().message, fmt::join(input.map.names(), ", ")));
    }

    /// One fit, step by step.
    class Fitting
    {
    public:
      explicit Fitting(const FitInput &input)
          : input_(input), groups_(input.model), exact_(input.model, input.data.conditions, options(exact_tolerance))
      {
        result_.error =
            model_error(input.reduced.record, input.problem.model_error, input.data, Eigen::VectorXd::Ones(input.data.n()));
        result_.integrator_tolerance = exact_tolerance;
      }

      Estimate run()
      {
        search();
        refine();
        polish();
        if (admit_larger_model_error())
          polish();
        settle();
        return std::move(result_);
      }

    private:
      ExactOptions options(const double tolerance) const
      {
        return {.relative_tolerance = tolerance, .n_threads = input_.n_threads, .by = input_.map.needed()};
      }

      void show(const std::string &what, const double done) const
      {
        if (input_.on_progress)
          input_.on_progress(what, done);
      }

      SearchOptions search_options() const
      {
        return {.method          = search_method(input_.problem.method),
                .max_evaluations = input_.problem.max_evaluations,
                .seed            = static_cast<unsigned long>(input_.problem.seed)};
      }

      /// From all starts, on a table; without one, if a node of it cannot be computed, with exact displacements.
      void search()
      {
        const SearchMisfit                       misfit(input_, result_.error);
        const std::shared_ptr<DisplacementTable> table        = search_table();
        const auto                               make_problem = [&] {
          std::shared_ptr<DisplacementSource> source;
          if (table)
            source = table->copy();
          else
            source = std::make_shared<ExactDisplacements>(
                input_.model, input_.data.conditions,
                ExactOptions{.relative_tolerance = search_tolerance, .by = input_.map.needed()});
          return minimization_problem(misfit.misfit, source);
        };
        result_.starts = starts_of(input_);
        result_.search =
            search_from_all(make_problem, result_.starts, {.search = search_options(), .n_threads = input_.n_threads});
        if (result_.search.best < 0)
          refuse_all_starts(input_, result_.search);
      }

      std::shared_ptr<DisplacementTable> search_table()
      {
        std::string failure;
        auto        table = DisplacementTable::make(input_.model, input_.data.conditions,
                                                    input_.map.group_box(groups_, input_.map.lower(), input_.map.upper()),
                                                    {.relative_tolerance = search_tolerance,
                                                     .n_threads          = input_.n_threads,
                                                     .on_progress = [this](const double done) { show("search", done); }},
                                                    failure);
        if (table)
        {
          result_.table_error = table->interpolation_error();
          result_.n_runs += table->n_runs();
        }
        return table;
      }

      /// Once more with exact displacements and sensitivities, from the table's minima.
      void refine()
      {
        const SearchMisfit misfit(input_, result_.error);
        const auto         source  = std::shared_ptr<DisplacementSource>(std::shared_ptr<void>(), &exact_);
        const auto         problem = minimization_problem(misfit.misfit, source);
        for (const Eigen::VectorXd &x : distinct_minima(result_.search, problem.upper - problem.lower))
        {
          Minimum minimum = search_minimum(problem, x, search_options());
          if (!result_.refined.is_feasible() ||
              (minimum.is_feasible() && minimum.objective < result_.refined.objective))
            result_.refined = std::move(minimum);
          show("refine", 0.5);
        }
        if (!result_.refined.is_feasible())
          throw ComputationError(fmt::format("the fit failed: {}", result_.refined.message));
        result_.unknowns = result_.refined.x;
      }

      /// Least squares with the model's error among the unknowns, and the noise level where it is free.
      void polish()
      {
        const Eigen::VectorXd x0 = result_.refined.x;
        result_.unknowns.conservativeResizeLike(
            Eigen::VectorXd::Zero(input_.map.size() + result_.error.n_components()));
        for (int round = 0; round < (free_noise() ? 4 : 1); ++round)
        {
          const Misfit               misfit = misfit_of(input_, result_);
          const LeastSquaresSolution solution =
              solve_least_squares(least_squares_problem(misfit, exact_), result_.unknowns);
          result_.polished = solution.converged;
          result_.unknowns = solution.unknowns;
          estimate_noise(misfit);
          show("polish", 0.5);
        }
        result_.polish_step = (result_.unknowns.head(input_.map.size()) - x0).lpNorm<Eigen::Infinity>();
      }

      const FreeParameter *free_noise() const
      {
        const auto found = std::find_if(input_.problem.free.begin(), input_.problem.free.end(),
                                        [](const auto &free) { return free.quantity == FittedQuantity::noise_scale; });
        return found == input_.problem.free.end() ? nullptr : &*found;
      }

      void estimate_noise(const Misfit &misfit)
      {
        if (const FreeParameter *noise = free_noise())
          if (const Prediction prediction = misfit.predict(exact_, result_.unknowns, true); prediction.failure.empty())
            result_.noise_scale =
                noise_scale_estimate(misfit, result_.unknowns, prediction, noise->lower, noise->upper);
      }

      /// Where the model's own indicator exceeds those of its held-out runs, its error is taken to grow with it.
      bool admit_larger_model_error();

      /// Exact to many digits: what is null must show.
      void settle()
      {
        ExactDisplacements exact(input_.model, input_.data.conditions, options(information_tolerance));
        const Misfit       misfit = misfit_of(input_, result_);
        describe(misfit, exact);
        if (slide_along_undecided())
          describe(misfit, exact);
        result_.n_runs += exact.n_runs() + exact_.n_runs();
      }

      void describe(const Misfit &misfit, DisplacementSource &source)
      {
        result_.prediction = misfit.predict(source, result_.unknowns, true);
        if (!result_.prediction.failure.empty())
          throw ComputationError(fmt::format("the fit failed at its estimate: {}", result_.prediction.failure));
        result_.information   = information(misfit, result_.unknowns, result_.prediction);
        const MisfitRows rows = misfit.rows(source, result_.unknowns, true);
        result_.misfit        = rows.misfit();
        result_.kkt_residual  = cosine(misfit, rows);
      }

      double cosine(const Misfit &misfit, const MisfitRows &rows) const
      {
        const Eigen::VectorXd lower = misfit.map().lower(), upper = misfit.map().upper();
        const double          size  = std::max(1., rows.rows.norm());
        double                worst = 0.;
        for (int j = 0; j < misfit.n_unknowns(); ++j)
        {
          const double slope = rows.by_unknowns.col(j).dot(rows.rows), norm = rows.by_unknowns.col(j).norm();
          const bool   held = j < misfit.n_parameters() && ((result_.unknowns[j] <= lower[j] && slope > 0.) ||
                                                          (result_.unknowns[j] >= upper[j] && slope < 0.));
          if (!held && norm > 0.)
            worst = std::max(worst, std::abs(slope) / (norm * size));
        }
        return worst;
      }

      /// Along what no data and no prior decide, to the point nearest the nominal swimmer: one answer, not any.
      bool slide_along_undecided()
      {
        const Eigen::MatrixXd &N = result_.information.undecided;
        if (N.cols() == 0)
          return false;
        const Eigen::VectorXd step = N * (N.transpose() * (input_.map.nominal() - result_.x()));
        const Eigen::VectorXd x = result_.x(), lower = input_.map.lower(), upper = input_.map.upper();
        double                share = 1.;
        for (Eigen::Index j = 0; j < x.size(); ++j)
          if (step[j] != 0.)
            share = std::min(share, std::max(0., ((step[j] > 0. ? upper[j] : lower[j]) - x[j]) / step[j]));
        result_.unknowns.head(x.size()) += share * step;
        return true;
      }

      const FitInput    &input_;
      MotionGroups       groups_;
      ExactDisplacements exact_;
      Estimate           result_;
    };

    bool Fitting::admit_larger_model_error()
    {
      const double usual   = held_out_indicator(input_.reduced.record);
      const int    n_fewer = n_modes_of_comparison(input_.reduced.n_modes());
      if (result_.error.relative_size == 0. || usual == 0. || n_fewer == input_.reduced.n_modes())
        return false;
      const CalibrationModel  fewer(truncated(input_.reduced, n_fewer));
      const CalibratedSwimmer swimmer = input_.map.swimmer(result_.unknowns.head(input_.map.size()));
      ExactDisplacements      compared(fewer, input_.data.conditions, {.n_threads = input_.n_threads, .by = {}});
      const Eigen::VectorXd   all = exact_.evaluate(swimmer, false).value_m;
      const Displacements    &few = compared.evaluate(swimmer, false);
      if (few.failed() || all.size() != few.value_m.size())
        return false;
      const Eigen::VectorXd indicator = (all - few.value_m).cwiseAbs().cwiseQuotient(all.cwiseAbs()) / usual;
      if (indicator.maxCoeff() <= 1.)
        return false;
      result_.error =
          model_error(input_.reduced.record, input_.problem.model_error, input_.data, indicator.cwiseMax(1.));
      return true;
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
    return Fitting(input).run();
  }
} // namespace swimtwin
