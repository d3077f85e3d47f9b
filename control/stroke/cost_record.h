// How good a search had become by what it had cost.
#pragma once

#include <datasets/run/plan_result.h>
#include <optimization/minimization_problem.h>

#include <algorithm>
#include <vector>

namespace swimtwin
{
  /// Keeps the best point by what it had cost when it was found.
  class CostRecord
  {
  public:
    explicit CostRecord(const double tolerance) : tolerance_(tolerance) {}

    /// True if it is the best so far.
    bool note(const Evaluation &evaluation, const long n_periods)
    {
      ++n_evaluations_;
      if (evaluation.failed())
        return false;
      const double violation = std::max(0., evaluation.constraints.size() ? evaluation.constraints.maxCoeff() : 0.);
      const PlanTraceStep step{n_periods, evaluation.objective, violation, n_evaluations_};
      if (!trace_.empty() && !better(step, trace_.back()))
        return false;
      trace_.push_back(step);
      return true;
    }

    std::vector<PlanTraceStep> trace() const { return trace_; }

  private:
    bool better(const PlanTraceStep &a, const PlanTraceStep &b) const
    {
      const bool a_feasible = a.violation <= tolerance_, b_feasible = b.violation <= tolerance_;
      if (a_feasible != b_feasible)
        return a_feasible;
      return a_feasible ? a.objective < b.objective : a.violation < b.violation;
    }

    double                     tolerance_;
    long                       n_evaluations_ = 0;
    std::vector<PlanTraceStep> trace_;
  };
} // namespace swimtwin
