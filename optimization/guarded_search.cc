#include <datasets/system/error.h>
#include <optimization/first_order_conditions.h>
#include <optimization/guarded_search.h>
#include <optimization/nlopt_run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Bounds and constraints this close, in their scales, count as met with equality.
    constexpr double active_distance = 1e-3;

    void require_searchable(const MinimizationProblem &problem, const Eigen::VectorXd &start,
                            const SearchOptions &options)
    {
      if (start.size() != problem.lower.size() || problem.upper.size() != problem.lower.size() || start.size() == 0)
        throw InputError(
            fmt::format("A search over {} variables needs as many lower bounds, upper bounds and starts; got "
                        "{} and {} and {}.",
                        problem.lower.size(), problem.lower.size(), problem.upper.size(), start.size()));
      for (Eigen::Index j = 0; j < start.size(); ++j)
        if (!(problem.lower[j] <= problem.upper[j]))
          throw InputError(fmt::format("The bounds of variable {} exclude every value: {} to {}.", j + 1,
                                       problem.lower[j], problem.upper[j]));
      if (problem.n_constraints > 0 && !takes_constraints(options.method))
        throw InputError(fmt::format("Method '{}' takes no constraints; use ccsaq, mma, slsqp, cobyla or isres.",
                                     to_string(options.method)));
      if (options.method == SearchMethod::isres && !(problem.upper - problem.lower).allFinite())
        throw InputError("Method 'isres' needs finite bounds of every variable.");
    }

    std::string name_of_worst(const MinimizationProblem &problem, const Eigen::VectorXd &scaled_constraints)
    {
      Eigen::Index worst = 0;
      scaled_constraints.maxCoeff(&worst);
      return static_cast<std::size_t>(worst) < problem.constraint_names.size()
                 ? problem.constraint_names[worst]
                 : fmt::format("constraint {}", worst + 1);
    }

    /// The search, run by run. Each run has scales of its own; violations and the first-order residual are measured in
    /// the problem's, or in those of the first run.
    class Search
    {
    public:
      Search(const MinimizationProblem &problem, const SearchOptions &options)
          : problem_(problem), options_(options),
            record_(problem, options.max_evaluations, options.feasibility_tolerance)
      {
      }

      Minimum run(const Eigen::VectorXd &start)
      {
        const Eigen::VectorXd inside = start.cwiseMax(problem_.lower).cwiseMin(problem_.upper);
        variables_                   = variable_scales(problem_, inside);
        if (begin(inside))
          while (!run_once() && may_restart())
            ++result_.n_restarts;
        conclude();
        return std::move(result_);
      }

    private:
      bool begin(const Eigen::VectorXd &start)
      {
        here_ = record_.differentiate(record_.evaluate(start, uses_gradients(options_.method)),
                                      uses_gradients(options_.method), variables_);
        if (here_.evaluation.failed())
          return false;
        first_ = scales_at(variables_, here_.evaluation);
        if (problem_.constraint_scale.size() > 0)
          first_.constraints = problem_.constraint_scale;
        record_.set_constraint_scales(first_.constraints);
        return true;
      }

      /// True if the first-order conditions hold at the best point.
      bool run_once()
      {
        const std::size_t n_before = record_.trace().size();
        run_nlopt(problem_, scales_at(variables_, here_.evaluation), here_.x, options_, record_);
        here_     = record_.differentiate(*record_.best(), uses_gradients(options_.method), variables_);
        improved_ = record_.trace().size() > n_before;
        return judge();
      }

      bool judge()
      {
        if (here_.evaluation.failed())
          return false;
        const Evaluation evaluation = scaled(here_.evaluation, first_);
        const auto       conditions =
            first_order_conditions(here_.x.cwiseQuotient(variables_), problem_.lower.cwiseQuotient(variables_),
                                   problem_.upper.cwiseQuotient(variables_), evaluation, active_distance);
        // In the first scales the gradient at the start is 1; the objective's own size keeps the measure from asking
        // for more than its digits give where a search starts at the minimum.
        const double size =
            std::max({evaluation.gradient.lpNorm<Eigen::Infinity>(), 1., 1e-2 * std::abs(evaluation.objective)});
        result_.kkt_residual = conditions.residual / size;
        result_.multipliers = (conditions.multipliers.array() * first_.objective / first_.constraints.array()).matrix();
        return record_.is_feasible() && result_.kkt_residual <= options_.kkt_tolerance;
      }

      bool may_restart() const
      {
        return result_.n_restarts < options_.max_restarts && !record_.is_spent() && !here_.evaluation.failed() &&
               (improved_ || result_.n_restarts == 0);
      }

      void conclude()
      {
        result_.n_evaluations = record_.n_evaluations();
        result_.n_gradients   = record_.n_gradients();
        result_.trace         = record_.trace();
        if (!record_.best())
        {
          result_.status  = MinimumStatus::failed;
          result_.message = record_.first_failure();
          return;
        }
        const SearchPoint &best = *record_.best();
        result_.x               = best.x;
        result_.objective       = best.evaluation.objective;
        result_.constraints     = best.evaluation.constraints;
        result_.violation       = best.violation;
        set_status();
      }

      void set_status()
      {
        const auto end = [&](const MinimumStatus status, const std::string &message) {
          result_.status  = status;
          result_.message = message;
        };
        if (!record_.is_feasible())
          end(MinimumStatus::infeasible,
              fmt::format("no point was found that meets '{}'; the nearest misses it by {:.3g}",
                          name_of_worst(problem_, result_.constraints.cwiseQuotient(first_.constraints)),
                          result_.constraints.maxCoeff()));
        else if (here_.evaluation.failed())
          end(MinimumStatus::stalled, here_.evaluation.failure);
        else if (result_.kkt_residual <= options_.kkt_tolerance)
          end(MinimumStatus::converged, fmt::format("first-order residual {:.1e}", result_.kkt_residual));
        else if (record_.is_spent())
          end(MinimumStatus::budget_exhausted,
              fmt::format("{} evaluations were not enough; first-order residual {:.1e}", result_.n_evaluations,
                          result_.kkt_residual));
        else
          end(MinimumStatus::stalled, fmt::format("method '{}' stopped with a first-order residual of {:.1e}",
                                                  to_string(options_.method), result_.kkt_residual));
      }

      const MinimizationProblem &problem_;
      const SearchOptions       &options_;
      SearchRecord               record_;
      Eigen::VectorXd            variables_; ///< their scales
      Scales                     first_;
      SearchPoint                here_; ///< the best point, with derivatives
      bool                       improved_ = false;
      Minimum                    result_;
    };
  } // namespace

  Minimum search_minimum(const MinimizationProblem &problem, const Eigen::VectorXd &start, const SearchOptions &options)
  {
    require_searchable(problem, start, options);
    return Search(problem, options).run(start);
  }
} // namespace swimtwin
