#include <tests/stress/hard_swimmers.h>

#include <algorithm>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    constexpr double gap_m = 0.15e-3; // a tenth of the head's height

    /// The reference box with one wall moved.
    std::vector<std::string> box(const double left_m, const double right_m, const double bottom_m)
    {
      const double top_m = 10e-3;
      const auto   pair  = [](const double x, const double y) {
        std::ostringstream text;
        text << "[" << x << ", " << y << "]";
        return text.str();
      };
      return {"domain.center_m=" + pair((left_m + right_m) / 2, (bottom_m + top_m) / 2),
              "domain.size_m=" + pair(right_m - left_m, top_m - bottom_m)};
    }
  } // namespace

  TEST(Wall, ATenthOfTheHeadBesideTheTailsTipIsSwumAlong)
  {
    // Tilted, so that the tip and not the head is nearest: its lowest point is at y = 7.65 mm sin(-0.1) - 0.1 mm.
    expect_convergence(hard_swimmer(box(-20e-3, 20e-3, -0.8637e-3 - gap_m), 40, 3).with({"head.angle_rad=-0.1"}));
  }

  TEST(Wall, ATenthOfTheHeadBesideTheSwimmerIsSwumAlong)
  {
    const Motion motion = expect_convergence(hard_swimmer(box(-20e-3, 20e-3, -0.75e-3 - gap_m), 40, 3));
    const auto   lowest = std::min_element(motion.trajectory.begin(), motion.trajectory.end(),
                                           [](const auto &a, const auto &b) { return a.head_y_m < b.head_y_m; });
    ASSERT_NE(lowest, motion.trajectory.end());
    EXPECT_GT(lowest->head_y_m, -gap_m); // a wall is not swum through
  }

  TEST(Wall, ATenthOfTheHeadBehindTheTailsTipIsLeft)
  {
    expect_convergence(hard_swimmer(box(-20e-3, 7.75e-3 + gap_m, -10e-3)).with({"domain.walls.right=no-slip"}));
  }
} // namespace swimtwin
