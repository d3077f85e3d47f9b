#include <tests/stress/hard_swimmers.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    Motion turn(const double period_s, const std::vector<std::string> &settings)
    {
      const TemporaryFolder folder;
      return expect_convergence(swimmer_in_turning_field(folder, period_s, settings), 80);
    }

    double final_angle(const Motion &motion)
    {
      return motion.trajectory.empty() ? 0. : motion.trajectory.back().head_angle_rad;
    }
  } // namespace

  TEST(TurningField, TakesAStiffTailAround)
  {
    EXPECT_GT(final_angle(turn(8., {"tail.young_modulus_Pa=1e9"})), 1.5 * std::numbers::pi);
  }

  TEST(TurningField, TakesASoftTailAround)
  {
    EXPECT_GT(final_angle(turn(4., {"tail.young_modulus_Pa=1e3", "tail.law=neo-hookean"})), std::numbers::pi);
  }

  TEST(TurningField, BeyondStepOutLeavesTheHeadBehind)
  {
    EXPECT_LT(std::abs(final_angle(turn(0.2, {"fluid.inertia=none"}))), 0.5 * std::numbers::pi);
  }

  TEST(StartAgainstTheField, TurnsTheSwimmerRound)
  {
    const Motion motion =
        expect_convergence(hard_swimmer({"head.angle_rad=3.141592653589793", "field.by_T=1e-3"}, 80, 2.), 80);
    ASSERT_FALSE(motion.trajectory.empty());
    EXPECT_LT(std::cos(motion.trajectory.front().head_angle_rad), -0.99);
    EXPECT_GT(std::cos(motion.trajectory.back().head_angle_rad), 0.7);
  }

  // With 1e8 A/m an equilibrium grows in a fraction of a step: an implicit step that is not divided
  // lands on it and stays, with a closed balance.
  TEST(StartAgainstTheField, TurnsTheSwimmerRoundHoweverStrongTheField)
  {
    const ShrunkScene scene  = hard_swimmer({"head.angle_rad=3.141592653589793", "field.by_T=1e-3",
                                             "head.magnetization_A_m=1e8", "tail.young_modulus_Pa=1e9"},
                                            40, 0.25);
    const Motion      motion = simulate(scene);
    EXPECT_LT(std::cos(motion.trajectory.front().head_angle_rad), -0.99);
    EXPECT_GT(std::cos(motion.trajectory.back().head_angle_rad), 0.95);
    EXPECT_GT(motion.summary.n_step_halvings, 0);

    const TemporaryFolder folder;
    expect_failure(run_tool(simulate_arguments(scene.with({"numerics.max_step_halvings=1"}), folder.path / "run")), 1,
                   {"t = ", "unstable equilibrium", "after 1 halvings of the step", "[time] steps_per_period",
                    "max_step_halvings"});
  }
} // namespace swimtwin
