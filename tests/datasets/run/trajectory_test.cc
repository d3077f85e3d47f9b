#include <datasets/run/trajectory.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr double period_s = 0.8;

    /// Swims with 0.1 m per period along `heading`, wobbles with the period, and closes its power balance exactly but
    /// for `leak` times the magnetic work of a period. Powers are linear in time, so that the trapezoidal rule is
    /// exact.
    Trajectory make_trajectory(const int n_steps, const double heading, const double leak)
    {
      Trajectory trajectory;
      for (int i = 0; i <= n_steps; ++i)
      {
        TrajectoryRow row;
        const double  t        = i * 0.1 * period_s;
        const double  phase    = 2. * std::numbers::pi * t / period_s;
        const double  progress = 0.1 * t / period_s + 0.01 * (1. - std::cos(phase));
        row.time_s             = t;
        row.head_x_m           = 0.3 + progress * std::cos(heading);
        row.head_y_m           = -0.2 + progress * std::sin(heading);
        row.magnetic_power_W_m = 4.;
        row.external_power_W_m = 1.;
        row.elastic_energy_J_m = 2. * t;
        row.dissipation_W_m    = 4. + 1. - 2. - 4. * leak;
        trajectory.push_back(row);
      }
      return trajectory;
    }

    TrajectoryRow example_row()
    {
      TrajectoryRow row;
      row.time_s              = 0.1;
      row.head_x_m            = -1. / 3.;
      row.head_y_m            = std::numeric_limits<double>::denorm_min();
      row.head_angle_rad      = 1e300;
      row.tail_tip_x_m        = 7.75e-3;
      row.tail_tip_y_m        = -2e-7;
      row.tail_angle_rad      = std::nextafter(1., 2.);
      row.bx_T                = 5e-3;
      row.by_T                = -4.9e-3;
      row.magnetic_power_W_m  = 1.;
      row.external_power_W_m  = 2.;
      row.dissipation_W_m     = 3.;
      row.elastic_energy_J_m  = 4.;
      row.head_force_x_N_m    = 5.;
      row.head_force_y_N_m    = 6.;
      row.head_torque_N       = 7.;
      row.coupling_iterations = 3;
      row.n_unknowns          = 30000;
      row.remeshed            = true;
      return row;
    }
  } // namespace

  TEST(SummarizeMotion, DisplacementIsPositiveHeadFirst)
  {
    const double angle = 0.4; // the head points to angle + pi
    RunSummary   summary;
    summarize_motion(make_trajectory(30, angle + std::numbers::pi, 0.), period_s, angle, summary);
    ASSERT_EQ(summary.displacement_per_period_m.size(), 3u);
    for (const double displacement : summary.displacement_per_period_m)
      EXPECT_NEAR(displacement, 0.1, 1e-14);
    EXPECT_NEAR(summary.net_displacement_m.value(), 0.1, 1e-14);
  }

  TEST(SummarizeMotion, SidewaysMotionIsNoDisplacement)
  {
    RunSummary summary;
    summarize_motion(make_trajectory(20, 0.5 * std::numbers::pi, 0.), period_s, 0., summary);
    EXPECT_NEAR(summary.net_displacement_m.value(), 0., 1e-15);
  }

  TEST(SummarizeMotion, ClosedPowerBalanceHasNoImbalance)
  {
    RunSummary summary;
    summarize_motion(make_trajectory(20, 0., 0.), period_s, 0., summary);
    EXPECT_NEAR(summary.power_imbalance.value(), 0., 1e-13);
    EXPECT_NEAR(summary.worst_power_imbalance.value(), 0., 1e-13);
  }

  TEST(SummarizeMotion, LeakIsReportedRelativeToTheMagneticWork)
  {
    RunSummary summary;
    summarize_motion(make_trajectory(20, 0., -0.03), period_s, 0., summary);
    EXPECT_NEAR(summary.power_imbalance.value(), -0.03, 1e-13);
    EXPECT_NEAR(summary.worst_power_imbalance.value(), -0.03, 1e-13);
  }

  TEST(SummarizeMotion, WorstPeriodIsNotTheLastOne)
  {
    Trajectory       trajectory = make_trajectory(20, 0., 0.);
    const Trajectory leaking    = make_trajectory(20, 0., 0.25);
    for (std::size_t i = 0; i < 10; ++i)
      trajectory[i].dissipation_W_m = leaking[i].dissipation_W_m;
    RunSummary summary;
    summarize_motion(trajectory, period_s, 0., summary);
    EXPECT_NEAR(summary.power_imbalance.value(), 0., 1e-13);
    EXPECT_NEAR(summary.worst_power_imbalance.value(), 0.25 * 0.95,
                1e-13); // the last trapezium of the period leaks half
  }

  TEST(SummarizeMotion, RowsMayBeIrregular)
  {
    Trajectory trajectory = make_trajectory(20, 0., 0.1);
    trajectory.erase(trajectory.begin() + 3);
    trajectory.erase(trajectory.begin() + 13);
    RunSummary summary;
    summarize_motion(trajectory, period_s * (1. + 1e-10), 0., summary);
    EXPECT_NEAR(summary.power_imbalance.value(), 0.1, 1e-13);
  }

  TEST(SummarizeMotion, WithoutMagneticWorkImbalanceIsRelativeToDissipation)
  {
    Trajectory trajectory = make_trajectory(10, 0., 0.);
    for (TrajectoryRow &row : trajectory)
    {
      row.magnetic_power_W_m = row.elastic_energy_J_m = 0.;
      row.dissipation_W_m                             = 2.;
    }
    RunSummary summary;
    summarize_motion(trajectory, period_s, 0., summary);
    EXPECT_NEAR(summary.power_imbalance.value(), (1. - 2.) / 2., 1e-14);
    for (TrajectoryRow &row : trajectory)
      row.dissipation_W_m = 0.;
    summarize_motion(trajectory, period_s, 0., summary);
    EXPECT_FALSE(summary.power_imbalance.has_value()) << "0 would look like a closed balance";
  }

  TEST(SummarizeMotion, AnUnfinishedPeriodDoesNotCount)
  {
    RunSummary summary;
    summarize_motion(make_trajectory(19, 0., 0.), period_s, 0., summary);
    EXPECT_EQ(summary.displacement_per_period_m.size(), 1u);
    summarize_motion(make_trajectory(9, 0., 0.), period_s, 0., summary);
    EXPECT_TRUE(summary.displacement_per_period_m.empty());
    EXPECT_FALSE(summary.net_displacement_m.has_value());
    EXPECT_FALSE(summary.power_imbalance.has_value());
    EXPECT_FALSE(summary.worst_power_imbalance.has_value());
    EXPECT_FALSE(summary.work_of_last_period.has_value());
    summarize_motion({}, period_s, 0., summary);
    EXPECT_TRUE(summary.displacement_per_period_m.empty());
  }

  TEST(SummarizeMotion, NeedsARowAtTheEndOfEachPeriod)
  {
    Trajectory trajectory = make_trajectory(20, 0., 0.);
    trajectory.erase(trajectory.begin() + 10);
    RunSummary summary;
    expect_in(message_of<InputError>([&] { summarize_motion(trajectory, period_s, 0., summary); }), "end of period 1");
  }

  TEST(TrajectoryCsv, RoundTripKeepsEveryBit)
  {
    const TemporaryFolder folder;
    const Trajectory      written{example_row(), TrajectoryRow{}};
    write_trajectory_csv(folder.path / "trajectory.csv", written);
    const std::string text = content(folder.path / "trajectory.csv");
    EXPECT_EQ(text.substr(0, text.find(',', 60)), "time_s,head_x_m,head_y_m,head_angle_rad,tail_tip_x_m,tail_tip_y_m");

    const Trajectory read = read_trajectory_csv(folder.path / "trajectory.csv");
    write_trajectory_csv(folder.path / "again.csv", read);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(text, content(folder.path / "again.csv"));
    EXPECT_EQ(read[0].head_x_m, written[0].head_x_m);
    EXPECT_EQ(read[0].head_y_m, written[0].head_y_m);
    EXPECT_EQ(read[0].tail_angle_rad, written[0].tail_angle_rad);
    EXPECT_EQ(read[0].head_torque_N, 7.);
    EXPECT_EQ(read[0].n_unknowns, 30000);
    EXPECT_TRUE(read[0].remeshed);
    EXPECT_FALSE(read[1].remeshed);
  }

  TEST(TrajectoryCsv, HasWhatAMotionInSpaceNeeds)
  {
    const TemporaryFolder folder;
    const auto            file = folder.path / "trajectory.csv";
    TrajectoryRow         row  = example_row();
    row.head_z_m               = 1e-10 * row.head_x_m; // round-off of both halves
    row.head_qw                = .5;
    row.head_qy                = -std::sqrt(.75);
    const auto header          = [&] {
      write_trajectory_csv(file, {row}, 3);
      const std::string text = content(file);
      return text.substr(0, text.find('\n'));
    };
    const std::string planar = header();
    expect_in(planar, "head_torque_N_m,fluid_force_x_N,");
    EXPECT_TRUE(planar.ends_with("remeshed,head_z_m,tail_tip_z_m,head_qw,head_qx,head_qy,head_qz"));
    const std::string out_of_plane = planar +
                                     ",bz_T,head_force_z_N,head_torque_x_N_m,head_torque_y_N_m,fluid_force_z_N,"
                                     "fluid_torque_x_N_m,fluid_torque_y_N_m";
    row.bz_T = 1e-3;
    EXPECT_EQ(header(), out_of_plane);
    row.bz_T              = 0.; // weight along z
    row.head_z_m          = 1. / 3.;
    row.head_torque_x_N_m = 2. / 3.;
    EXPECT_EQ(header(), out_of_plane);
    const Trajectory read = read_trajectory_csv(file);
    EXPECT_EQ(numbers_of(read.at(0)), numbers_of(row));
  }

  TEST(TrajectoryCsv, NeverHoldsNaN)
  {
    const TemporaryFolder folder;
    Trajectory            trajectory(2);
    trajectory[1].dissipation_W_m = std::nan("");
    const std::string message =
        message_of<ComputationError>([&] { write_trajectory_csv(folder.path / "trajectory.csv", trajectory); });
    expect_in(message, "dissipation_W_m at time 0 s is not a finite number");
    EXPECT_EQ(n_files(folder.path), 0u);
  }

  TEST(TrajectoryCsv, ReadsATableFromBeforeInertia)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write(
                   "trajectory.csv", "time_s,head_x_m,head_y_m,head_angle_rad,tail_tip_x_m,tail_tip_y_m,tail_angle_rad,bx_T,by_T,"
                                                "magnetic_power_W_m,external_power_W_m,dissipation_W_m,elastic_energy_J_m,"
                                                "head_force_x_N_m,head_force_y_N_m,head_torque_N,coupling_iterations,n_unknowns,remeshed\n"
                                                "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,1\n");
    const Trajectory read = read_trajectory_csv(file);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].head_torque_N, 15.);
    EXPECT_EQ(read[0].kinetic_energy_J_m, 0.);
    EXPECT_TRUE(read[0].remeshed);
  }

  TEST(TrajectoryCsv, NamesAMissingColumn)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write("trajectory.csv", "time_s\n0\n");
    expect_in(message_of<InputError>([&] { read_trajectory_csv(file); }),
              "trajectory.csv:1: the column head_x_m is missing");
  }
} // namespace swimtwin
