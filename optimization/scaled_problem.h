// A minimisation problem in variables, objective and constraints of order one.
#pragma once

#include <optimization/minimization_problem.h>

namespace swimtwin
{
  /// Sizes that make a problem of order one near a point: z = x / variables, and so on.
  struct Scales
  {
    Eigen::VectorXd variables, constraints;
    double          objective = 1.;
  };

  /// The problem's own scale, or a tenth of the way between finite bounds, or the larger of 1 and the start's size.
  Eigen::VectorXd variable_scales(const MinimizationProblem &problem, const Eigen::VectorXd &start);
  /// Objective and constraints by the size of their gradients in scaled variables; those without a gradient there by
  /// their own size, or 1.
  Scales scales_at(const Eigen::VectorXd &variables, const Evaluation &evaluation);

  /// The same point in scaled quantities.
  Evaluation scaled(const Evaluation &evaluation, const Scales &scales);

  /// Gradient and jacobian by central differences over a thousandth of the scales, one-sided next to a bound; counts
  /// its evaluations. False if one of them failed.
  bool differentiate_by_differences(const MinimizationProblem &problem, const Eigen::VectorXd &variables,
                                    const Eigen::VectorXd &x, Evaluation &evaluation, int &n_evaluations);
} // namespace swimtwin
