#include <optimization/scaled_problem.h>
#include <optimization/search_record.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    bool is_finite(const SearchPoint &point)
    {
      const Evaluation &evaluation = point.evaluation;
      return std::isfinite(evaluation.objective) && evaluation.constraints.allFinite() &&
             (!point.with_derivatives || (evaluation.gradient.allFinite() && evaluation.jacobian.allFinite()));
    }
  } // namespace

  SearchRecord::SearchRecord(const MinimizationProblem &problem, const int max_evaluations,
                             const double feasibility_tolerance)
      : problem_(problem), max_evaluations_(max_evaluations), tolerance_(feasibility_tolerance),
        constraint_scales_(Eigen::VectorXd::Ones(problem.n_constraints))
  {
  }

  const SearchPoint &SearchRecord::evaluate(const Eigen::VectorXd &x, const bool derivatives)
  {
    if (last_.x.size() == x.size() && last_.x == x && (last_.with_derivatives || !derivatives))
      return last_;
    last_ = {x, {}, derivatives, 0.};
    problem_.evaluate(x, derivatives, last_.evaluation);
    ++n_evaluations_;
    n_gradients_ += derivatives;
    check(last_);
    if (!last_.evaluation.failed())
      remember(last_);
    return last_;
  }

  SearchPoint SearchRecord::differentiate(const SearchPoint &point, const bool own_derivatives,
                                          const Eigen::VectorXd &variable_scales)
  {
    if (point.with_derivatives)
      return point;
    if (own_derivatives)
      return evaluate(point.x, true);
    SearchPoint here      = point;
    here.with_derivatives = true;
    if (!differentiate_by_differences(problem_, variable_scales, point.x, here.evaluation, n_evaluations_))
      here.evaluation.failure = "a point next to it could not be computed";
    else
      check(here);
    return here;
  }

  void SearchRecord::set_constraint_scales(const Eigen::VectorXd &scales)
  {
    constraint_scales_ = scales;
    if (best_)
      best_->violation = violation(best_->evaluation.constraints);
  }

  void SearchRecord::check(SearchPoint &point)
  {
    Evaluation &evaluation = point.evaluation;
    if (!evaluation.failed() && !is_finite(point))
      evaluation.failure = "the objective, a constraint or a derivative is not finite";
    if (evaluation.failed() && first_failure_.empty())
      first_failure_ = evaluation.failure;
    if (!evaluation.failed())
      point.violation = violation(evaluation.constraints);
  }

  void SearchRecord::remember(const SearchPoint &point)
  {
    if (best_ && point.x == best_->x && point.with_derivatives)
      best_ = point;
    else if (is_better(point))
    {
      best_ = point;
      trace_.push_back({n_evaluations_, point.evaluation.objective, point.violation});
    }
  }

  /// Feasible before infeasible; then by objective, or by violation.
  bool SearchRecord::is_better(const SearchPoint &point) const
  {
    if (!best_)
      return true;
    const bool feasible = point.violation <= tolerance_;
    if (feasible != is_feasible())
      return feasible;
    return feasible ? point.evaluation.objective < best_->evaluation.objective : point.violation < best_->violation;
  }

  double SearchRecord::violation(const Eigen::VectorXd &constraints) const
  {
    return constraints.size() == 0 ? 0. : std::max(0., constraints.cwiseQuotient(constraint_scales_).maxCoeff());
  }
} // namespace swimtwin
