// Problems whose minimum is known.
#pragma once

#include <optimization/minimization_problem.h>

#include <cmath>

namespace swimtwin
{
  /// NLopt's tutorial: sqrt(x2) above two cubics, minimum 0.5443 at (1/3, 8/27). `x1_unit`, `x2_unit` and
  /// `objective_unit` state the same problem in other units.
  inline MinimizationProblem tutorial_problem(const double x1_unit = 1., const double x2_unit = 1.,
                                              const double objective_unit = 1.)
  {
    MinimizationProblem problem;
    problem.lower         = Eigen::Vector2d(-5. * x1_unit, 0.);
    problem.upper         = Eigen::Vector2d(5. * x1_unit, 20. * x2_unit);
    problem.n_constraints = 2;
    problem.evaluate      = [=](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
      const double a = x[0] / x1_unit, b = x[1] / x2_unit, root = std::sqrt(b);
      evaluation.objective   = objective_unit * root;
      evaluation.constraints = Eigen::Vector2d(std::pow(2. * a, 3) - b, std::pow(1. - a, 3) - b);
      if (!derivatives)
        return;
      evaluation.gradient = Eigen::Vector2d(0., objective_unit * 0.5 / (root * x2_unit));
      evaluation.jacobian.resize(2, 2);
      evaluation.jacobian << 24. * a * a / x1_unit, -1. / x2_unit, -3. * std::pow(1. - a, 2) / x1_unit, -1. / x2_unit;
    };
    return problem;
  }

  /// Rosenbrock's valley, minimum 0 at (1, 1).
  inline MinimizationProblem rosenbrock_problem()
  {
    MinimizationProblem problem;
    problem.lower    = Eigen::Vector2d(-3., -3.);
    problem.upper    = Eigen::Vector2d(3., 3.);
    problem.evaluate = [](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
      const double valley    = x[1] - x[0] * x[0];
      evaluation.objective   = 100. * valley * valley + std::pow(1. - x[0], 2);
      evaluation.constraints = Eigen::VectorXd(0);
      if (!derivatives)
        return;
      evaluation.gradient = Eigen::Vector2d(-400. * x[0] * valley - 2. * (1. - x[0]), 200. * valley);
      evaluation.jacobian = Eigen::MatrixXd(0, 2);
    };
    return problem;
  }
} // namespace swimtwin
