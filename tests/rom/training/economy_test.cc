#include <rom/training/economy.h>

#include <tests/datasets/example_scenes.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    Scene scene_with(const std::vector<std::string> &overrides)
    {
      return parse_scene(swimmer_toml, "swimmer", overrides);
    }
  } // namespace

  TEST(Economy, DifferenceIsRelativeToDisplacementsAndCountsWaysAcross)
  {
    Eigen::Matrix2Xd others(2, 3);
    others << 1., 2., 1e-9, // along the heading
        0., 5., 3.;
    Eigen::Matrix2Xd ways = others;
    EXPECT_EQ(relative_difference(ways, others), 0.);
    ways(1, 0) += 3e-3; // of 1
    ways(0, 2) += 3e-4; // of a twentieth of 2
    EXPECT_NEAR(relative_difference(ways, others), std::sqrt((3e-3 * 3e-3 + 3e-3 * 3e-3) / 3.), 1e-12);
    EXPECT_TRUE(are_alike(ways, others, 2.5e-2));
    EXPECT_FALSE(are_alike(ways, others, 2.4e-2));
  }

  TEST(Economy, AWayThatIsMissingIsLikeNoOther)
  {
    Eigen::Matrix2Xd ways = Eigen::Matrix2Xd::Ones(2, 3), others = ways;
    ways(0, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(are_alike(ways, others, 1e9));
    EXPECT_FALSE(are_alike(others, ways, 1e9));
  }

  // Tail, angle and all else that is not a member's are the scene's.
  TEST(Economy, WaysAreTheScenes)
  {
    ReducedModel model = example_model();
    model.range        = {{1e5, 1e5}, {1.52, 1.52}, {1e5, 1e5}, {.8, .8}, {5e-3, 5e-3}, {5e-3, 5e-3}};
    const auto plain   = third_ways(model, scene_with({}));
    ASSERT_TRUE(plain.allFinite());
    EXPECT_GT(plain.norm(), 0.);
    EXPECT_FALSE(are_alike(third_ways(model, scene_with({"tail.magnetization_A_m=5e4"})), plain, .5));
    EXPECT_FALSE(are_alike(third_ways(model, scene_with({"head.angle_rad=0.5"})), plain, .5));
  }
} // namespace swimtwin
