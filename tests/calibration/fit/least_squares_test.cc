#include <calibration/fit/least_squares.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    /// Rosenbrock's valley: minimum 0 at (1, 1).
    LeastSquaresProblem valley(const double largest_first)
    {
      const double        far = std::numeric_limits<double>::max();
      LeastSquaresProblem problem;
      problem.n_rows   = 2;
      problem.lower    = Eigen::Vector2d(-far, -far);
      problem.upper    = Eigen::Vector2d(largest_first, far);
      problem.evaluate = [](const Eigen::VectorXd &u, Eigen::VectorXd &rows, Eigen::MatrixXd &by_unknowns) {
        rows = Eigen::Vector2d(10. * (u[1] - u[0] * u[0]), 1. - u[0]);
        by_unknowns.resize(2, 2);
        by_unknowns << -20. * u[0], 10., -1., 0.;
        return true;
      };
      return problem;
    }
  } // namespace

  TEST(LeastSquares, FindsTheEndOfTheValley)
  {
    const auto solution = solve_least_squares(valley(10.), Eigen::Vector2d(-1.2, 1.));
    EXPECT_TRUE(solution.converged);
    EXPECT_LT((solution.unknowns - Eigen::Vector2d(1., 1.)).norm(), 1e-7);
    EXPECT_LT(solution.half_square, 1e-14);
  }

  TEST(LeastSquares, StopsAtABound)
  {
    const auto solution = solve_least_squares(valley(0.5), Eigen::Vector2d(-1.2, 1.), {}, {.max_evaluations = 200});
    EXPECT_EQ(solution.unknowns[0], 0.5);
    EXPECT_NEAR(solution.unknowns[1], 0.25, 1e-5);
  }

  TEST(LeastSquares, LargeResidualsDoNotPushTheOthersAlongABound)
  {
    LeastSquaresProblem problem;
    problem.n_rows   = 2;
    problem.lower    = Eigen::Vector2d(-1., -1.);
    problem.upper    = Eigen::Vector2d(1., 1.);
    problem.evaluate = [](const Eigen::VectorXd &u, Eigen::VectorXd &rows, Eigen::MatrixXd &by_unknowns) {
      rows = Eigen::Vector2d(1e6 * (u[0] - 2.), 1e3 * (u[1] - 0.5 - 10. * (u[0] - 1.))); // the first wants to be 2
      by_unknowns.resize(2, 2);
      by_unknowns << 1e6, 0., -1e4, 1e3;
      return true;
    };
    const auto solution = solve_least_squares(problem, Eigen::Vector2d(0., 0.));
    EXPECT_EQ(solution.unknowns[0], 1.);
    EXPECT_NEAR(solution.unknowns[1], 0.5, 1e-9);
  }

  TEST(LeastSquares, KeepsWhatIsHeld)
  {
    const auto solution = solve_least_squares(valley(10.), Eigen::Vector2d(0.3, 7.), {0});
    EXPECT_TRUE(solution.converged);
    EXPECT_EQ(solution.unknowns[0], 0.3);
    EXPECT_NEAR(solution.unknowns[1], 0.09, 1e-9);
  }

  TEST(LeastSquares, SaysWhenRowsCannotBeComputed)
  {
    LeastSquaresProblem problem = valley(10.);
    problem.evaluate            = [](const auto &, auto &, auto &) { return false; };
    EXPECT_FALSE(solve_least_squares(problem, Eigen::Vector2d(0., 0.)).converged);
  }
} // namespace swimtwin
