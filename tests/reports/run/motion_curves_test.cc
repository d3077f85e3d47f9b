#include <reports/run/motion_curves.h>

#include <tests/reports/synthetic_run.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    class MotionCurves : public ::testing::Test
    {
    protected:
      const Scene      scene      = synthetic_scene();
      const double     period_s   = scene.field.period_s();
      const Trajectory trajectory = synthetic_trajectory(period_s, 330, 100, 0.01);
      const TimeAxis   axis       = time_axis(scene, trajectory);
    };
  } // namespace

  TEST_F(MotionCurves, TimeIsCountedInPeriodsOfTheField)
  {
    EXPECT_NEAR(axis(2.5 * period_s), 2.5, 1e-14);
    EXPECT_EQ(axis.label, "time (periods of 1.25 s)");
  }

  TEST_F(MotionCurves, TimeIsInSecondsWithoutAPeriod)
  {
    Scene steady           = scene;
    steady.field           = FieldProgram::constant(1e-3, 0.);
    const TimeAxis seconds = time_axis(steady, trajectory);
    EXPECT_EQ(seconds(2.5), 2.5);
    EXPECT_EQ(seconds.label, "time (s)");
    EXPECT_EQ(last_periods(trajectory, seconds, 1).size(), trajectory.size());
  }

  TEST_F(MotionCurves, LastFullPeriodHasBothItsEnds)
  {
    const Rows rows = last_periods(trajectory, axis, 1);
    EXPECT_EQ(n_full_periods(trajectory, axis), 3);
    ASSERT_EQ(rows.size(), 101u);
    EXPECT_NEAR(rows.front().time_s, 2. * period_s, 1e-12);
    EXPECT_NEAR(rows.back().time_s, 3. * period_s, 1e-12);
    EXPECT_EQ(last_periods(trajectory, axis, 4).size(), trajectory.size());
  }

  TEST_F(MotionCurves, DisplacementIsThatOfTheSummary)
  {
    RunSummary summary;
    summarize_motion(trajectory, period_s, trajectory.front().head_angle_rad, summary);
    EXPECT_NEAR(displacement_m(trajectory, trajectory[300]) - displacement_m(trajectory, trajectory[200]),
                summary.net_displacement_m.value(), 1e-16);
    EXPECT_GT(summary.net_displacement_m.value(), 0.);
  }

  TEST_F(MotionCurves, ResidualIntegratesToTheImbalanceOfTheSummary)
  {
    RunSummary summary;
    summarize_motion(trajectory, period_s, 0., summary);
    const Rows rows = last_periods(trajectory, axis, 1);
    double     mean = 0.;
    for (const IntervalPower &power : interval_powers(rows))
      mean += power.residual_W_m / static_cast<double>(rows.size() - 1);
    EXPECT_NEAR(mean / power_scale_W_m(rows), summary.power_imbalance.value(), 1e-12);
    EXPECT_NEAR(summary.power_imbalance.value(), -0.01, 1e-4);
  }

  TEST_F(MotionCurves, MissingWorkIsTheImbalanceOfTheSummary)
  {
    RunSummary summary;
    summarize_motion(trajectory, period_s, 0., summary);
    const WorkBalance balance = work_balance(last_periods(trajectory, axis, 1));
    EXPECT_NEAR(balance.missing_J_m() / std::abs(balance.magnetic_J_m), summary.power_imbalance.value(), 1e-12);
    // mean powers times the period; what oscillates averages out
    EXPECT_NEAR(balance.magnetic_J_m, 4e-4 * period_s, 1e-12);
    EXPECT_NEAR(balance.dissipated_J_m, 1.01 * 4e-4 * period_s, 1e-12);
    EXPECT_NEAR(balance.stored_J_m, 0., 1e-12);
  }

  TEST(StrokeLoop, AreaOfAnEllipseAndItsSense)
  {
    // the polygon of n points on an ellipse has the area n/2 sin(2 pi/n) a b
    constexpr int n = 100;
    const double  a = 0.4, b = 0.3, lag = 0.3 * pi;
    Trajectory    loop(n + 1);
    for (int i = 0; i <= n; ++i)
    {
      const double phase = 2. * pi * i / n;
      auto        &row   = loop[static_cast<std::size_t>(i)];
      row.head_angle_rad = a * std::sin(phase);
      row.tail_angle_rad = b * std::sin(phase - lag);
    }
    const double area = 0.5 * n * std::sin(2. * pi / n) * a * b * std::sin(lag);
    EXPECT_NEAR(stroke_loop_area_rad2(loop), area, 1e-14);
    std::reverse(loop.begin(), loop.end());
    EXPECT_NEAR(stroke_loop_area_rad2(loop), -area, 1e-14);
  }

  TEST(StrokeLoop, ReciprocalMotionEnclosesNothing)
  {
    Trajectory line(50);
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      line[i].head_angle_rad = std::sin(0.3 * static_cast<double>(i));
      line[i].tail_angle_rad = 0.7 * line[i].head_angle_rad;
    }
    EXPECT_NEAR(stroke_loop_area_rad2(line), 0., 1e-14);
  }
} // namespace swimtwin
