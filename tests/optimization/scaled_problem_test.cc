#include <optimization/scaled_problem.h>

#include <tests/optimization/known_problems.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    TEST(ScaledProblem, DifferencesAgreeWithTheGradient)
    {
      const MinimizationProblem problem = tutorial_problem(1e-6, 1e7, 1e-9);
      const Eigen::Vector2d     x(0.4e-6, 2e7);
      Evaluation                exact, differences;
      problem.evaluate(x, true, exact);
      problem.evaluate(x, false, differences);
      int n_evaluations = 0;
      ASSERT_TRUE(differentiate_by_differences(problem, Eigen::Vector2d(1e-6, 1e7), x, differences, n_evaluations));
      EXPECT_EQ(n_evaluations, 4);
      EXPECT_NEAR((differences.gradient - exact.gradient).norm() / exact.gradient.norm(), 0., 1e-5);
      EXPECT_NEAR((differences.jacobian - exact.jacobian).norm() / exact.jacobian.norm(), 0., 1e-5);
    }

    TEST(ScaledProblem, UnitsDoNotMatter)
    {
      const Eigen::Vector2d x(1.2, 5.), in_other_units(1.2e-6, 5e7);
      const auto            at = [](const MinimizationProblem &problem, const Eigen::Vector2d &point) {
        Evaluation evaluation;
        problem.evaluate(point, true, evaluation);
        return scaled(evaluation, scales_at(variable_scales(problem, point), evaluation));
      };
      const Evaluation one = at(tutorial_problem(), x), other = at(tutorial_problem(1e-6, 1e7, 1e-9), in_other_units);
      EXPECT_NEAR((one.gradient - other.gradient).norm(), 0., 1e-12);
      EXPECT_NEAR((one.jacobian - other.jacobian).norm(), 0., 1e-12);
      EXPECT_NEAR((one.constraints - other.constraints).norm(), 0., 1e-12);
    }
  } // namespace
} // namespace swimtwin
