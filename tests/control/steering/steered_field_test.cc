#include <control/steering/mean_position.h>
#include <control/steering/steered_field.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    SteeringPlan some_plan()
    {
      SteeringPlan plan;
      plan.carrier    = {std::make_shared<SinusoidalField>(), Eigen::Vector2d(5e-3, 4e-3), 0.8};
      plan.angles_rad = Eigen::VectorXd::NullaryExpr(20, [](Eigen::Index i) { return std::sin(1.3 * i); });
      return plan;
    }
  } // namespace

  TEST(SteeredField, WindowIsThePlan)
  {
    const SteeringPlan plan = some_plan();
    for (const auto &[start, length] : {std::pair{0., 2.}, {0.3, 1.7}, {3.5, 0.05}, {2.25, 3.}})
    {
      const Drive window = window_of(plan, start, length);
      EXPECT_DOUBLE_EQ(window.frequency_Hz, 0.8 / length);
      EXPECT_EQ(static_cast<Eigen::Index>(window.field->parameter_names().size()), window.parameters.size());
      for (const double phase : {0., 0.2, 0.77, 1.})
        EXPECT_LE((window.field->value_T(phase, window.parameters) - plan.field_T(start + length * phase)).norm(),
                  1e-17);
    }
  }

  TEST(SteeredField, ABackgroundIsFeltAndNotPlayed)
  {
    SteeringPlan plan = some_plan();
    const Drive  bare = window_of(plan, 0.4, 2.);
    plan.background_T = {3e-4, -2e-4};
    const Drive felt  = window_of(plan, 0.4, 2.);
    for (const double phase : {0., 0.3, 0.9})
      EXPECT_LE((felt.field->value_T(phase, felt.parameters) - bare.field->value_T(phase, bare.parameters) -
                 plan.background_T)
                    .norm(),
                1e-17);
    EXPECT_EQ(plan.field_T(0.7), some_plan().field_T(0.7));
  }

  TEST(SteeredField, TurningKeepsTheFieldsSize)
  {
    const SteeringPlan plan = some_plan();
    for (double t = 0.; t < 8.; t += 0.37)
      EXPECT_NEAR(plan.field_T(t).norm(), plan.carrier.field->value_T(t, plan.carrier.parameters).norm(), 1e-17);
    EXPECT_NEAR(plan.largest_field_T(), std::hypot(5e-3, 4e-3), 1e-8);
  }

  TEST(SteeredField, SlopesAreDerivatives)
  {
    constexpr double h    = 1e-5;
    SteeringPlan     plan = some_plan();
    plan.background_T     = {3e-4, -2e-4};
    const Drive window    = window_of(plan, 1.2, 2.);
    for (const double phase : {0., 0.31, 0.66, 1.})
    {
      const Eigen::Matrix2Xd slopes = window.field->slopes(phase, window.parameters);
      for (Eigen::Index i = 0; i < window.parameters.size(); ++i)
      {
        Eigen::VectorXd up = window.parameters, down = up;
        up[i] += h;
        down[i] -= h;
        const Eigen::Vector2d exact =
            (window.field->value_T(phase, up) - window.field->value_T(phase, down)) / (2. * h);
        EXPECT_LE((slopes.col(i) - exact).norm(), 1e-5 * 5e-3);
      }
    }
  }

  TEST(SteeredField, AngleRateIsTheDerivativeOfTheAngle)
  {
    constexpr double   h    = 1e-5;
    const SteeringPlan plan = some_plan();
    for (const double t : {0.2, 1.7, 5.3})
      EXPECT_NEAR(plan.angle_rate(t), (plan.angle_rad(t + h) - plan.angle_rad(t - h)) / (2. * h), 1e-8);
  }

  TEST(MeanPosition, FollowsADriftWithoutItsSwing)
  {
    MeanPosition record;
    for (int i = 0; i <= 60; ++i)
      record.add(i / 20., {0.1 * i / 20. + std::cos(2. * std::numbers::pi * i / 20.), 1.});
    EXPECT_TRUE(record.has_period());
    const Eigen::Vector2d mean = record.mean_at(3.);
    EXPECT_NEAR(mean.x(), 0.25, 1e-12);
    EXPECT_NEAR(mean.y(), 1., 1e-14);
    EXPECT_NEAR(record.integral_at(2.025).y(), 2.025, 1e-14);
  }
} // namespace swimtwin
