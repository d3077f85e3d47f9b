// What is to be minimised, and what comes back.
#pragma once

#include <Eigen/Dense>

#include <functional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Objective and constraints at one point. A point that could not be computed says why in `failure`; its numbers do
  /// not count then.
  struct Evaluation
  {
    double          objective = 0.;
    Eigen::VectorXd gradient;
    Eigen::VectorXd constraints; ///< each at most 0 where it is met
    Eigen::MatrixXd jacobian;    ///< of the constraints, one row each
    std::string     failure;

    bool failed() const { return !failure.empty(); }
  };

  /// Minimise the objective such that lower <= x <= upper and every constraint <= 0.
  struct MinimizationProblem
  {
    Eigen::VectorXd lower, upper; ///< bounds, infinite where there is none
    /// Change of each variable that matters, positive; empty: a tenth of the way between finite bounds, else the larger
    /// of 1 and the start's size.
    Eigen::VectorXd scale;
    int             n_constraints = 0;
    /// Change of each constraint that matters, positive; empty: its change over the variables' scales at the start.
    Eigen::VectorXd constraint_scale = {};
    /// Names of the constraints for messages; may be empty.
    std::vector<std::string> constraint_names = {};
    /// Sets gradient and jacobian if `derivatives`, else leaves them alone. Owned by one thread at a time.
    std::function<void(const Eigen::VectorXd &x, bool derivatives, Evaluation &)> evaluate;

    int n_variables() const { return static_cast<int>(lower.size()); }
  };

  /// Where a search began, went and ended. Violations are relative to the constraints' scales.
  enum class MinimumStatus {
    not_run,
    converged,        ///< feasible, and the first-order conditions hold
    budget_exhausted, ///< feasible, but evaluations ran out before the first-order conditions held
    stalled,          ///< feasible, the method stopped, yet the first-order conditions do not hold
    infeasible,       ///< no feasible point was seen
    failed            ///< no point could be computed
  };
  std::string to_string(MinimumStatus status);

  struct SearchStep
  {
    int    n_evaluations = 0;
    double objective = 0., violation = 0.;
  };

  struct Minimum
  {
    MinimumStatus status = MinimumStatus::not_run;
    std::string   message; ///< one sentence: why the search ended, which constraint is not met

    Eigen::VectorXd x; ///< the best feasible point seen; the least infeasible one if none was
    double          objective = 0.;
    Eigen::VectorXd constraints;
    double          violation = 0.; ///< the largest, in constraint scales
    /// Largest component of the Lagrangian's gradient that no bound holds, in scaled variables, relative to the
    /// objective's own gradient there or at the start, whichever is larger.
    double          kkt_residual = 0.;
    Eigen::VectorXd multipliers; ///< of the constraints, in the problem's units

    int                     n_evaluations = 0, n_gradients = 0, n_restarts = 0;
    std::vector<SearchStep> trace; ///< of every improvement

    bool converged() const { return status == MinimumStatus::converged; }
    bool is_feasible() const
    {
      return status == MinimumStatus::converged || status == MinimumStatus::budget_exhausted ||
             status == MinimumStatus::stalled;
    }
  };
} // namespace swimtwin
