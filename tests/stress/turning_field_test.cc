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
} // namespace swimtwin
