// How far a point is from satisfying the conditions of Karush, Kuhn and Tucker.
#pragma once

#include <optimization/minimization_problem.h>

namespace swimtwin
{
  struct FirstOrderConditions
  {
    /// Largest component of the Lagrangian's gradient that no active bound holds, and largest product of a multiplier
    /// with its constraint's distance from zero; per unit change of the variables.
    double          residual = 0.;
    Eigen::VectorXd multipliers; ///< of the constraints, at least 0
  };

  /// Multipliers by nonnegative least squares over the bounds and constraints within `active` of being met with
  /// equality. Variables and constraints in their scales: changes and distances of order 1 matter.
  FirstOrderConditions first_order_conditions(const Eigen::VectorXd &x, const Eigen::VectorXd &lower,
                                              const Eigen::VectorXd &upper, const Evaluation &evaluation,
                                              double active);
} // namespace swimtwin
