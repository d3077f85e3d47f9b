#include <optimization/nonnegative_least_squares.h>

#include <limits>
#include <vector>

namespace swimtwin
{
  namespace
  {
    /// Least squares over the free columns, zero elsewhere.
    Eigen::VectorXd solve_free(const Eigen::MatrixXd &A, const Eigen::VectorXd &b, const std::vector<bool> &is_free)
    {
      std::vector<Eigen::Index> columns;
      for (Eigen::Index j = 0; j < A.cols(); ++j)
        if (is_free[j])
          columns.push_back(j);
      Eigen::VectorXd solution = Eigen::VectorXd::Zero(A.cols());
      if (!columns.empty())
      {
        const Eigen::MatrixXd part = A(Eigen::all, columns);
        solution(columns)          = part.completeOrthogonalDecomposition().solve(b).eval();
      }
      return solution;
    }

    /// Goes from `from` towards `to` until the first free coefficient reaches zero, which is then held there.
    void step_to_boundary(const Eigen::VectorXd &to, Eigen::VectorXd &from, std::vector<bool> &is_free)
    {
      double       step  = 1.;
      Eigen::Index first = -1;
      for (Eigen::Index j = 0; j < from.size(); ++j)
        if (is_free[j] && to[j] <= 0. && from[j] <= step * (from[j] - to[j]))
        {
          step  = from[j] - to[j] > 0. ? from[j] / (from[j] - to[j]) : 0.;
          first = j;
        }
      from += step * (to - from);
      for (Eigen::Index j = 0; j < from.size(); ++j)
        if (is_free[j] && (j == first || from[j] <= 0.))
        {
          from[j]    = 0.;
          is_free[j] = false;
        }
    }
  } // namespace

  Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd &A, const Eigen::VectorXd &b)
  {
    Eigen::VectorXd   c = Eigen::VectorXd::Zero(A.cols());
    std::vector<bool> is_free(A.cols(), false);
    const double      tolerance = 1e-12 * (1. + A.cwiseAbs().sum()) * (1. + b.norm());
    for (Eigen::Index n_sweeps = 0; n_sweeps < 3 * A.cols(); ++n_sweeps)
    {
      const Eigen::VectorXd descent  = A.transpose() * (b - A * c);
      Eigen::Index          entering = -1;
      for (Eigen::Index j = 0; j < A.cols(); ++j)
        if (!is_free[j] && descent[j] > tolerance && (entering < 0 || descent[j] > descent[entering]))
          entering = j;
      if (entering < 0)
        break;
      is_free[entering]      = true;
      Eigen::VectorXd target = solve_free(A, b, is_free);
      while ((target.array() < 0.).any())
      {
        step_to_boundary(target, c, is_free);
        target = solve_free(A, b, is_free);
      }
      c = target;
    }
    return c;
  }
} // namespace swimtwin
