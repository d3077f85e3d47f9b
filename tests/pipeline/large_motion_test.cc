#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    using std::numbers::pi;

    /// One turn of a field of 7 mT per period, 60 samples.
    std::string turning_field(const double period_s)
    {
      constexpr int      n = 60;
      std::ostringstream csv;
      csv << "time_s,bx_T,by_T\n";
      for (int i = 0; i < n; ++i)
        csv << period_s * i / n << "," << 7e-3 * std::cos(2. * pi * i / n) << "," << 7e-3 * std::sin(2. * pi * i / n)
            << "\n";
      return csv.str();
    }

    /// The reference swimmer's scene with its [field] replaced by the turning one.
    ShrunkScene swimmer_in_turning_field(const TemporaryFolder &folder, const double period_s)
    {
      folder.write("turn.csv", turning_field(period_s));
      std::string text  = content(std::string(places::scenes) + "/reference-2d-casefile.toml");
      const auto  field = text.find("[field]"), next = text.find("[time]");
      text.replace(field, next - field,
                   "[field]\nprogram = \"turn.csv\"\nperiod_s = " + std::to_string(period_s) + "\n");
      ShrunkScene scene = coarse_swimmer(80, 1.);
      scene.name        = folder.write("turning.toml", text);
      return scene;
    }

    Motion turn(const double period_s, const std::vector<std::string> &settings)
    {
      const TemporaryFolder folder;
      return simulate(swimmer_in_turning_field(folder, period_s).with(settings));
    }

    template <typename Value>
    double largest(const Trajectory &trajectory, const Value &value)
    {
      double result = 0.;
      for (const TrajectoryRow &row : trajectory)
        result = std::max(result, value(row));
      return result;
    }
  } // namespace

  // Slow enough (8 s a turn) for the head to follow: it lags by less than a quarter turn.
  TEST(LargeMotion, TheHeadTurnsBeyondAFullTurnByRemeshing)
  {
    const Motion motion = turn(8., {"time.periods=1.25"});
    EXPECT_EQ(motion.summary.status, "completed");
    EXPECT_GE(motion.summary.n_remeshes, 1);
    const double angle = motion.trajectory.back().head_angle_rad;
    std::cout << "head turned by " << angle << " rad, " << motion.summary.n_remeshes << " remeshings" << std::endl;
    EXPECT_GT(angle, 2. * pi);
    EXPECT_NEAR(angle, 2.5 * pi, 0.5 * pi);
    EXPECT_LE(std::abs(motion.summary.power_imbalance.value()), 0.01);
  }

  // Twenty times softer than shipped, in a field that turns within 4 s.
  TEST(LargeMotion, ASoftTailBendsPastARightAngle)
  {
    const Motion motion = turn(4., {"tail.young_modulus_Pa=4e3"});
    EXPECT_EQ(motion.summary.status, "completed");
    const auto bend = [](const TrajectoryRow &row) { return std::abs(row.tail_angle_rad - row.head_angle_rad); };
    std::cout << "tail bent by " << largest(motion.trajectory, bend) << " rad" << std::endl;
    EXPECT_GT(largest(motion.trajectory, bend), 0.5 * pi);
    EXPECT_LE(std::abs(motion.summary.power_imbalance.value()), 0.01);
  }

  // A computation that cannot be done says when, why and what to change, and leaves no half results.
  TEST(LargeMotion, AnImpossibleStepFailsWithTimeCauseAndRemedy)
  {
    const TemporaryFolder folder;
    const auto            scene =
        swimmer_in_turning_field(folder, 2.).with({"tail.young_modulus_Pa=1e2", "numerics.max_step_halvings=0"});
    expect_failure(run_tool(simulate_arguments(scene, folder.path / "run")), 1, {"t = ", "steps_per_period"});
    EXPECT_FALSE(std::filesystem::exists(folder.path / "run/trajectory.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder.path / "run/snapshots.h5"));
    EXPECT_EQ(read_run_summary_json(folder.path / "run/summary.json").summary.status.substr(0, 7), "failed:");
  }
} // namespace swimtwin
