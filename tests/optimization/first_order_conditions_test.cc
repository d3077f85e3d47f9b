#include <optimization/first_order_conditions.h>

#include <gtest/gtest.h>

#include <limits>

namespace swimtwin
{
  namespace
  {
    const Eigen::Vector2d no_lower = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());
    const Eigen::Vector2d no_upper = -no_lower;

    Evaluation with_gradient(const Eigen::Vector2d &gradient)
    {
      return {0., gradient, Eigen::VectorXd(0), Eigen::MatrixXd(0, 2), ""};
    }

    TEST(FirstOrderConditions, ResidualWithoutConstraintsIsTheGradient)
    {
      const auto conditions =
          first_order_conditions(Eigen::Vector2d::Zero(), no_lower, no_upper, with_gradient({0.3, -2.}), 1e-6);
      EXPECT_DOUBLE_EQ(conditions.residual, 2.);
    }

    TEST(FirstOrderConditions, BoundHoldsOnlyWhatPushesAgainstIt)
    {
      const Eigen::Vector2d lower(0., 0.);
      EXPECT_NEAR(first_order_conditions(lower, lower, no_upper, with_gradient({1., 2.}), 1e-6).residual, 0., 1e-12);
      EXPECT_NEAR(first_order_conditions(lower, lower, no_upper, with_gradient({1., -2.}), 1e-6).residual, 2., 1e-12);
    }

    TEST(FirstOrderConditions, InactiveConstraintHoldsNothing)
    {
      Evaluation evaluation  = with_gradient({-1., 0.});
      evaluation.constraints = Eigen::VectorXd::Constant(1, -0.5);
      evaluation.jacobian    = Eigen::RowVector2d(1., 0.);
      EXPECT_NEAR(first_order_conditions(Eigen::Vector2d::Zero(), no_lower, no_upper, evaluation, 1e-3).residual, 1.,
                  1e-12);
      evaluation.constraints[0] = 0.;
      const auto conditions     = first_order_conditions(Eigen::Vector2d::Zero(), no_lower, no_upper, evaluation, 1e-3);
      EXPECT_NEAR(conditions.residual, 0., 1e-12);
      EXPECT_NEAR(conditions.multipliers[0], 1., 1e-12);
    }

    TEST(FirstOrderConditions, ConstraintThatIsNotQuiteMetCountsByItsPrice)
    {
      Evaluation evaluation  = with_gradient({-1., 0.});
      evaluation.constraints = Eigen::VectorXd::Constant(1, -1e-4);
      evaluation.jacobian    = Eigen::RowVector2d(1., 0.);
      EXPECT_NEAR(first_order_conditions(Eigen::Vector2d::Zero(), no_lower, no_upper, evaluation, 1e-3).residual, 1e-4,
                  1e-12);
    }
  } // namespace
} // namespace swimtwin
