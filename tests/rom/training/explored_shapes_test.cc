#include <rom/training/explored_shapes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  TEST(ExploredShapes, DifferenceOfWaysIsRelativeToEachButNotToThoseThatStand)
  {
    Eigen::Matrix2Xd ways(2, 3), others(2, 3);
    others << 1., 0., 0., 0., 2., 1e-9;
    ways = others;
    EXPECT_EQ(relative_difference(ways, others), 0.);
    ways(1, 0) += 3e-3; // of 1
    ways(0, 2) += 3e-4; // of a twentieth of 2
    EXPECT_NEAR(relative_difference(ways, others), std::sqrt((3e-3 * 3e-3 + 3e-3 * 3e-3) / 3.), 1e-12);
  }

  TEST(ExploredShapes, AWayThatIsMissingIsLikeNoOther)
  {
    Eigen::Matrix2Xd ways = Eigen::Matrix2Xd::Ones(2, 3), others = ways;
    ways(0, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(relative_difference(ways, others) <= 1e9);
    EXPECT_FALSE(relative_difference(others, ways) <= 1e9);
  }
} // namespace swimtwin
