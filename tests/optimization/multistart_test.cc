#include <optimization/multistart.h>

#include <tests/optimization/known_problems.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    /// Himmelblau's function: four minima of value 0.
    MinimizationProblem himmelblau()
    {
      MinimizationProblem problem;
      problem.lower    = Eigen::Vector2d(-5., -5.);
      problem.upper    = Eigen::Vector2d(5., 5.);
      problem.evaluate = [](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
        const double a = x[0] * x[0] + x[1] - 11., b = x[0] + x[1] * x[1] - 7.;
        evaluation.objective   = a * a + b * b;
        evaluation.constraints = Eigen::VectorXd(0);
        if (derivatives)
        {
          evaluation.gradient = Eigen::Vector2d(4. * a * x[0] + 2. * b, 2. * a + 4. * b * x[1]);
          evaluation.jacobian = Eigen::MatrixXd(0, 2);
        }
      };
      return problem;
    }

    TEST(Multistart, FindsTheMinimaThereAre)
    {
      const MinimizationProblem problem = himmelblau();
      const Multistart          result = search_from_all(himmelblau, sobol_points(problem.lower, problem.upper, 24, 1));
      ASSERT_TRUE(result.found());
      EXPECT_NEAR(result.minima[result.best].objective, 0., 1e-8);
      int n_quadrants[2][2] = {};
      for (const Minimum &minimum : result.minima)
        if (minimum.converged() && minimum.objective < 1e-6)
          ++n_quadrants[minimum.x[0] > 0.][minimum.x[1] > 0.];
      EXPECT_TRUE(n_quadrants[0][0] && n_quadrants[0][1] && n_quadrants[1][0] && n_quadrants[1][1]);
    }

    TEST(Multistart, ThreadsDoNotChangeTheResult)
    {
      const MinimizationProblem problem = himmelblau();
      const Eigen::MatrixXd     starts  = sobol_points(problem.lower, problem.upper, 12, 3);
      MultistartOptions         one, two;
      one.n_threads      = 1;
      two.n_threads      = 2;
      int n_done         = 0;
      two.on_progress    = [&](int) { ++n_done; };
      const Multistart a = search_from_all(himmelblau, starts, one), b = search_from_all(himmelblau, starts, two);
      EXPECT_EQ(a.best, b.best);
      EXPECT_EQ(n_done, 12);
      for (std::size_t i = 0; i < a.minima.size(); ++i)
        EXPECT_EQ(a.minima[i].x, b.minima[i].x);
    }

    TEST(Multistart, NothingFeasibleIsSaid)
    {
      const auto impossible = [] {
        MinimizationProblem problem = himmelblau();
        problem.evaluate = [](const Eigen::VectorXd &, bool, Evaluation &evaluation) { evaluation.failure = "never"; };
        return problem;
      };
      const Multistart result = search_from_all(impossible, sobol_points(himmelblau().lower, himmelblau().upper, 3, 1));
      EXPECT_EQ(result.best, -1);
      EXPECT_FALSE(result.found());
    }
  } // namespace
} // namespace swimtwin
