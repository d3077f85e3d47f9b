// The one place that calls NLopt. Its return codes are not believed: the answer is the best feasible point that was
// seen, and it counts as found only if the first-order conditions hold there.
#pragma once

#include <optimization/minimization_problem.h>
#include <optimization/search_method.h>

namespace swimtwin
{
  struct SearchOptions
  {
    SearchMethod method          = SearchMethod::ccsaq;
    int          max_evaluations = 500;
    double       step_tolerance  = 1e-8; ///< in scaled variables: the method stops
    /// A found minimum has no larger first-order residual. Methods without gradients are checked by differences.
    double kkt_tolerance         = 1e-4;
    double feasibility_tolerance = 1e-6; ///< in constraint scales
    /// A method that stops where the first-order conditions do not hold starts anew from its best point, with fresh
    /// scales.
    int           max_restarts = 3;
    unsigned long seed         = 1; ///< of the global methods
  };

  /// Throws InputError for bounds that cross, a start of another length, or constraints that the method cannot take.
  /// The start is moved into the bounds.
  Minimum search_minimum(const MinimizationProblem &problem, const Eigen::VectorXd &start,
                         const SearchOptions &options = {});
} // namespace swimtwin
