#include <calibration/uncertainty/refit.h>

namespace swimtwin
{
  Refit::Refit(const FitInput &input, const Estimate &estimate)
      : input_(input), estimate_(estimate), table_(estimate.local->copy()), misfit_(misfit_of(input, estimate)),
        last_(estimate.unknowns)
  {
  }

  /// Undecided directions are held at the estimate by springs: nothing else would.
  LeastSquaresSolution Refit::solve(const Eigen::VectorXd &start, const std::vector<int> &held)
  {
    LeastSquaresProblem    problem = least_squares_problem(misfit_, *table_);
    const Eigen::MatrixXd &N       = estimate_.information.undecided;
    if (N.cols() > 0)
    {
      const auto evaluate = problem.evaluate;
      problem.n_rows += static_cast<int>(N.cols());
      problem.evaluate = [this, evaluate, &N](const Eigen::VectorXd &unknowns, Eigen::VectorXd &rows,
                                              Eigen::MatrixXd &by_unknowns) {
        if (!evaluate(unknowns, rows, by_unknowns))
          return false;
        const Eigen::Index n = rows.size(), p = N.rows();
        rows.conservativeResize(n + N.cols());
        rows.tail(N.cols()) = N.transpose() * (unknowns.head(p) - estimate_.x());
        by_unknowns.conservativeResize(n + N.cols(), Eigen::NoChange);
        by_unknowns.bottomRows(N.cols()).setZero();
        by_unknowns.bottomLeftCorner(N.cols(), p) = N.transpose();
        return true;
      };
    }
    return solve_least_squares(problem, start, held);
  }

  LeastSquaresSolution Refit::with_held(const int j, const double x_j, const bool warm)
  {
    Eigen::VectorXd start             = warm ? last_ : estimate_.unknowns;
    start[j]                          = x_j;
    const LeastSquaresSolution result = solve(start, {j});
    last_                             = result.unknowns;
    return result;
  }

  LeastSquaresSolution Refit::with_data(const Eigen::VectorXd &observed_m, const Eigen::VectorXd &prior_means)
  {
    misfit_.observed_m  = observed_m;
    misfit_.prior_means = prior_means;
    return solve(estimate_.unknowns, {});
  }

  bool Refit::covers(const Eigen::VectorXd &unknowns) const
  {
    return table_->covers(input_.map.swimmer(unknowns.head(input_.map.size())));
  }

  Eigen::VectorXd Refit::predictions(const Eigen::VectorXd &unknowns)
  {
    return misfit_.predict(*table_, unknowns, false).value_m;
  }
} // namespace swimtwin
