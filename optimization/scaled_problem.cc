#include <optimization/scaled_problem.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    double size_or_one(const double gradient, const double value)
    {
      const double size = gradient > 0. ? gradient : std::abs(value);
      return size > 0. && std::isfinite(size) ? size : 1.;
    }
  } // namespace

  Eigen::VectorXd variable_scales(const MinimizationProblem &problem, const Eigen::VectorXd &start)
  {
    if (problem.scale.size() > 0)
      return problem.scale;
    Eigen::VectorXd scales(start.size());
    for (Eigen::Index j = 0; j < start.size(); ++j)
    {
      const double range = problem.upper[j] - problem.lower[j];
      scales[j]          = std::isfinite(range) && range > 0. ? 0.1 * range : std::max(1., std::abs(start[j]));
    }
    return scales;
  }

  Scales scales_at(const Eigen::VectorXd &variables, const Evaluation &evaluation)
  {
    Scales scales{variables, Eigen::VectorXd::Ones(evaluation.constraints.size()), 1.};
    scales.objective =
        size_or_one(evaluation.gradient.cwiseProduct(variables).lpNorm<Eigen::Infinity>(), evaluation.objective);
    for (Eigen::Index i = 0; i < evaluation.constraints.size(); ++i)
      scales.constraints[i] =
          size_or_one(evaluation.jacobian.row(i).transpose().cwiseProduct(variables).lpNorm<Eigen::Infinity>(),
                      evaluation.constraints[i]);
    return scales;
  }

  Evaluation scaled(const Evaluation &evaluation, const Scales &scales)
  {
    Evaluation result;
    result.objective   = evaluation.objective / scales.objective;
    result.gradient    = evaluation.gradient.cwiseProduct(scales.variables) / scales.objective;
    result.constraints = evaluation.constraints.cwiseQuotient(scales.constraints);
    if (evaluation.constraints.size() > 0)
      result.jacobian =
          scales.constraints.cwiseInverse().asDiagonal() * evaluation.jacobian * scales.variables.asDiagonal();
    result.failure = evaluation.failure;
    return result;
  }

  bool differentiate_by_differences(const MinimizationProblem &problem, const Eigen::VectorXd &variables,
                                    const Eigen::VectorXd &x, Evaluation &evaluation, int &n_evaluations)
  {
    evaluation.gradient.resize(x.size());
    evaluation.jacobian.resize(problem.n_constraints, x.size());
    for (Eigen::Index j = 0; j < x.size(); ++j)
    {
      Eigen::VectorXd above = x, below = x;
      above[j] = std::min(x[j] + 1e-3 * variables[j], problem.upper[j]);
      below[j] = std::max(x[j] - 1e-3 * variables[j], problem.lower[j]);
      Evaluation at_above, at_below;
      problem.evaluate(above, false, at_above);
      problem.evaluate(below, false, at_below);
      n_evaluations += 2;
      if (at_above.failed() || at_below.failed())
        return false;
      const double step          = above[j] > below[j] ? above[j] - below[j] : 1.; // equal bounds: no derivative
      evaluation.gradient[j]     = (at_above.objective - at_below.objective) / step;
      evaluation.jacobian.col(j) = (at_above.constraints - at_below.constraints) / step;
    }
    return true;
  }
} // namespace swimtwin
