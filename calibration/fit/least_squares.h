// Least squares between bounds by Levenberg and Marquardt's method.
#pragma once

#include <Eigen/Dense>

#include <functional>
#include <vector>

namespace swimtwin
{
  struct LeastSquaresProblem
  {
    int             n_rows = 0;
    Eigen::VectorXd lower, upper; ///< bounds, infinite where there is none
    /// Rows and their derivatives; false if they cannot be computed there.
    std::function<bool(const Eigen::VectorXd &unknowns, Eigen::VectorXd &rows, Eigen::MatrixXd &by_unknowns)> evaluate;
  };

  struct LeastSquaresSolution
  {
    bool            converged = false;
    Eigen::VectorXd unknowns;
    double          half_square   = 0.; ///< of the rows there
    int             n_evaluations = 0;
  };

  struct LeastSquaresOptions
  {
    double tolerance       = 1e-10; ///< of steps and of the gain, relative
    int    max_evaluations = 60;
  };

  /// Eigen's implementation of MINPACK's method, which knows no bounds: outside them the rows go on as straight lines
  /// from the nearest point, and stiff springs pull back; what ends at a bound is then held there while the others are
  /// solved for again. `held`: unknowns that stay at their start.
  LeastSquaresSolution solve_least_squares(const LeastSquaresProblem &problem, const Eigen::VectorXd &start,
                                           const std::vector<int> &held = {}, const LeastSquaresOptions &options = {});
} // namespace swimtwin
