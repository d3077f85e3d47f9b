#include <calibration/fit.h>
#include <datasets/error.h>
#include <rom/trust.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace swimtwin
{
  namespace
  {
    // Of the integration: for the search a few per mille of a displacement, for the estimate 1e-4 of it, and for what
    // is read off derivatives (null directions!) as many digits as there are.
    constexpr double search_tolerance = 1e-5, estimate_tolerance = 1e-7, information_tolerance = 1e-9;
    constexpr double search_interpolation = 1e-2, estimate_interpolation = 1e-5;
    constexpr int    most_refined = 3; // minima of the search that are looked at again
    constexpr int    most_rounds  = 4; // of moving the estimate's table to where the estimate is

    // The estimate's table reaches this many standard deviations, and at least this far in a logarithm.
    constexpr double standard_deviations = 6., least_half_width = 0.03;
    /// A step of the polish below this share of a standard deviation is none.
    constexpr double settled = 0.02;

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

    /// One fit, step by step.
    class Fitting
    {
    public:
      explicit Fitting(const FitInput &input) : input_(input), groups_(input.model)
      {
        set_model_error(Eigen::VectorXd::Ones(input.data.n()));
        result_.integrator_tolerance = estimate_tolerance;
      }

      Estimate run()
      {
        search();
        refine();
        if (admit_larger_model_error())
          estimate();
        if (slide_along_undecided())
          describe();
        return std::move(result_);
      }

      Estimate run_near(const std::shared_ptr<DisplacementTable> &table, const Eigen::VectorXd &x)
      {
        result_.local = table;
        result_.unknowns.setZero(input_.map.size() + result_.error.n_components());
        result_.unknowns.head(x.size()) = x;
        polish(result_.unknowns);
        describe(table->evaluate(swimmer(), true));
        const Eigen::VectorXd step = remaining_step();
        result_.polish_step        = step.head(x.size()).lpNorm<Eigen::Infinity>();
        result_.polished           = in_standard_deviations(step) <= settled && table->covers(swimmer());
        return std::move(result_);
      }

    private:
      void show(const std::string &what, const double done) const
      {
        if (input_.on_progress)
          input_.on_progress(what, done);
      }

      void set_model_error(const Eigen::VectorXd &growth)
      {
        result_.error = model_error(input_.reduced.record, input_.problem.model_error, input_.data, growth);
      }

      SearchOptions search_options() const
      {
        return {.method          = search_method(input_.problem.method),
                .max_evaluations = input_.problem.max_evaluations,
                .seed            = static_cast<unsigned long>(input_.problem.seed)};
      }

      GroupBox everywhere() const { return input_.map.group_box(groups_, input_.map.lower(), input_.map.upper()); }

      std::shared_ptr<DisplacementTable> table(const GroupBox &box, const TableOptions &options)
      {
        std::string failure;
        auto        made = DisplacementTable::make(input_.model, input_.data.conditions, box, options, failure);
        if (made)
          result_.n_runs += made->n_runs();
        return made;
      }

      /// From all starts, on a table; without one, if a node of it cannot be computed, with exact displacements.
      void search()
      {
        const SearchMisfit misfit(input_, result_.error);
        const auto         found        = table(everywhere(), {.relative_tolerance  = search_tolerance,
                                                               .interpolation_error = search_interpolation,
                                                               .n_threads           = input_.n_threads,
                                                               .on_progress = [this](double done) { show("search", done); }});
        const auto         make_problem = [&] {
          std::shared_ptr<DisplacementSource> source;
          if (found)
            source = found->copy();
          else
            source = exact(search_tolerance, 1);
          return minimization_problem(misfit.misfit, source);
        };
        result_.table_error = found ? found->interpolation_error() : 0.;
        result_.starts      = starts_of(input_);
        result_.search =
            search_from_all(make_problem, result_.starts, {.search = search_options(), .n_threads = input_.n_threads});
        if (result_.search.best < 0)
          refuse_all_starts(input_, result_.search);
      }

      std::unique_ptr<ExactDisplacements> exact(const double tolerance, const int n_threads) const
      {
        return std::make_unique<ExactDisplacements>(
            input_.model, input_.data.conditions,
            ExactOptions{.relative_tolerance = tolerance, .n_threads = n_threads, .by = input_.map.needed()});
      }

      /// Every minimum of the search that may be the best one, followed to where it is on a table of its own.
      void refine()
      {
        const Eigen::VectorXd   width = input_.map.upper() - input_.map.lower();
        std::optional<Estimate> best;
        for (const Eigen::VectorXd &x : distinct_minima(result_.search, width))
        {
          result_.unknowns.setZero(input_.map.size() + result_.error.n_components());
          result_.unknowns.head(x.size()) = x;
          estimate();
          if (!best || result_.misfit < best->misfit)
            best = result_;
          best->n_runs = result_.n_runs;
        }
        result_ = std::move(*best);
      }

      /// Search on a table around the estimate, polish there, and look with exact displacements and sensitivities
      /// whether that is the minimum; if not, again from where those lead.
      void estimate()
      {
        result_.unknowns.conservativeResizeLike(
            Eigen::VectorXd::Zero(input_.map.size() + result_.error.n_components()));
        if (search_table_)
          describe(search_table_->evaluate(swimmer(), true));
        else
          describe();
        for (int round = 0; round < most_rounds; ++round)
        {
          show("estimate", static_cast<double>(round) / most_rounds);
          const Eigen::VectorXd before = result_.unknowns;
          make_local_table();
          polish(before);
          describe();
          const Eigen::VectorXd step = remaining_step();
          result_.polish_step        = step.head(input_.map.size()).lpNorm<Eigen::Infinity>();
          result_.polished           = in_standard_deviations(step) <= settled && result_.local->covers(swimmer());
          if (result_.polished)
            return;
          if (result_.local->covers(swimmer()))
            result_.unknowns += step;
          clip();
        }
      }

      CalibratedSwimmer swimmer() const { return input_.map.swimmer(result_.unknowns.head(input_.map.size())); }

      /// As wide in the groups as the information at the estimate says, within what the bounds allow.
      GroupBox local_box() const
      {
        GroupBox              box    = everywhere();
        const Eigen::VectorXd centre = groups_.values(swimmer());
        const Eigen::MatrixXd by_x =
            groups_.slopes() *
            input_.map.slopes(result_.unknowns.head(input_.map.size())).topRows<n_motion_quantities>();
        for (Eigen::Index g = 0; g < centre.size(); ++g)
        {
          const double half =
              std::max(standard_deviations * result_.information.standard_deviation(by_x.row(g)), least_half_width);
          box.lower[g] = std::max(box.lower[g], centre[g] - half);
          box.upper[g] = std::min(box.upper[g], centre[g] + half);
        }
        return box;
      }

      void make_local_table()
      {
        result_.local = table(local_box(), {.relative_tolerance  = estimate_tolerance,
                                            .interpolation_error = estimate_interpolation,
                                            .n_threads           = input_.n_threads});
        if (!result_.local)
          throw ComputationError("the fit failed: the swimmer cannot be computed everywhere near the estimate; move "
                                 "the bounds away from there.");
      }

      /// NLopt's answer on the table, then least squares with the model's error among the unknowns, and the noise level
      /// where it is free.
      void polish(const Eigen::VectorXd &start)
      {
        const SearchMisfit misfit(input_, result_.error);
        result_.refined = search_minimum(minimization_problem(misfit.misfit, result_.local),
                                         start.head(input_.map.size()), search_options());
        if (result_.refined.is_feasible())
          result_.unknowns.head(input_.map.size()) = result_.refined.x;
        for (int round = 0; round < (free_noise() ? 4 : 1); ++round)
        {
          const Misfit joint = misfit_of(input_, result_);
          result_.unknowns =
              solve_least_squares(least_squares_problem(joint, *result_.local), result_.unknowns).unknowns;
          estimate_noise(joint);
        }
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
          result_.noise_scale =
              noise_scale_estimate(misfit, result_.unknowns, misfit.predict(*result_.local, result_.unknowns, true),
                                   noise->lower, noise->upper);
      }

      /// Gauss and Newton's step of all unknowns by exact rows, without what is undecided or held by a bound.
      Eigen::VectorXd remaining_step() const
      {
        const Eigen::Index    p     = input_.map.size();
        const Eigen::VectorXd lower = input_.map.lower(), upper = input_.map.upper();
        Eigen::MatrixXd       J     = rows_.by_unknowns;
        const Eigen::VectorXd slope = J.transpose() * rows_.rows;
        for (Eigen::Index j = 0; j < p; ++j)
          if (is_held(j, slope[j], lower, upper))
            J.col(j).setZero();
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(J);
        solver.setThreshold(null_strength);
        return solver.solve(-rows_.rows);
      }

      bool is_held(const Eigen::Index j, const double slope, const Eigen::VectorXd &lower,
                   const Eigen::VectorXd &upper) const
      {
        return j < lower.size() &&
               ((result_.unknowns[j] <= lower[j] && slope > 0.) || (result_.unknowns[j] >= upper[j] && slope < 0.));
      }

      double in_standard_deviations(const Eigen::VectorXd &step) const
      {
        const Eigen::VectorXd x = step.head(input_.map.size());
        return (result_.information.whitened * x).norm();
      }

      void clip()
      {
        auto x = result_.unknowns.head(input_.map.size());
        x      = x.cwiseMax(input_.map.lower()).cwiseMin(input_.map.upper()).eval();
      }

      /// Predictions and information at the estimate with exact displacements and sensitivities.
      void describe()
      {
        const auto source = exact(information_tolerance, input_.n_threads);
        describe(source->evaluate(swimmer(), true));
        result_.n_runs += source->n_runs();
      }

      void describe(const Displacements &displacements)
      {
        if (displacements.failed())
          throw ComputationError(fmt::format("the fit failed at its estimate: {}", displacements.failure));
        KnownDisplacements known(displacements);
        const Misfit       misfit = misfit_of(input_, result_);
        rows_                     = misfit.rows(known, result_.unknowns, true);
        result_.prediction        = misfit.predict(known, result_.unknowns, true);
        result_.information       = information(misfit, result_.unknowns, result_.prediction);
        result_.misfit            = rows_.misfit();
        set_kkt_residual();
      }

      void set_kkt_residual()
      {
        const Eigen::VectorXd lower = input_.map.lower(), upper = input_.map.upper();
        const double          size = std::max(1., rows_.rows.norm());
        result_.kkt_residual       = 0.;
        for (Eigen::Index j = 0; j < rows_.by_unknowns.cols(); ++j)
        {
          const double slope = rows_.by_unknowns.col(j).dot(rows_.rows), norm = rows_.by_unknowns.col(j).norm();
          if (norm > 0. && !is_held(j, slope, lower, upper))
            result_.kkt_residual = std::max(result_.kkt_residual, std::abs(slope) / (norm * size));
        }
      }

      /// Where the model's own indicator exceeds those of its held-out runs, its error is taken to grow with it.
      bool admit_larger_model_error()
      {
        const double usual   = held_out_indicator(input_.reduced.record);
        const int    n_fewer = n_modes_of_comparison(input_.reduced.n_modes());
        if (result_.error.relative_size == 0. || usual == 0. || n_fewer == input_.reduced.n_modes())
          return false;
        const CalibrationModel fewer(truncated(input_.reduced, n_fewer));
        ExactDisplacements     compared(fewer, input_.data.conditions,
                                        {.relative_tolerance = estimate_tolerance, .n_threads = input_.n_threads});
        const Displacements   &few = compared.evaluate(swimmer(), false);
        if (few.failed())
          return false;
        const Eigen::VectorXd all    = result_.local->evaluate(swimmer(), false).value_m;
        const Eigen::VectorXd growth = (all - few.value_m).cwiseAbs().cwiseQuotient(usual * all.cwiseAbs());
        result_.n_runs += compared.n_runs();
        if (growth.maxCoeff() <= 1.)
          return false;
        set_model_error(growth.cwiseMax(1.));
        return true;
      }

      /// Along what no data and no prior decide, to the point nearest the nominal swimmer: one answer, not any.
      bool slide_along_undecided()
      {
        const Eigen::MatrixXd &N = result_.information.undecided;
        if (N.cols() == 0)
          return false;
        const Eigen::VectorXd x = result_.x(), lower = input_.map.lower(), upper = input_.map.upper();
        const Eigen::VectorXd step  = N * (N.transpose() * (input_.map.nominal() - x));
        double                share = 1.;
        for (Eigen::Index j = 0; j < x.size(); ++j)
          if (step[j] != 0.)
            share = std::min(share, std::max(0., ((step[j] > 0. ? upper[j] : lower[j]) - x[j]) / step[j]));
        result_.unknowns.head(x.size()) += share * step;
        return true;
      }

      const FitInput                    &input_;
      MotionGroups                       groups_;
      Estimate                           result_;
      MisfitRows                         rows_; ///< at the estimate
      std::shared_ptr<DisplacementTable> search_table_;
    };
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

  Estimate fit_near(const FitInput &input, const std::shared_ptr<DisplacementTable> &table, const Eigen::VectorXd &x)
  {
    return Fitting(input).run_near(table, x);
  }
} // namespace swimtwin
