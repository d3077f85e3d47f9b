#include <calibration/misfit/node_grid.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    NodeGrid five_by_four()
    {
      return {{Eigen::Vector2d(0., 1.), Eigen::Vector2d(4., 3.)}, {5, 4}};
    }
  } // namespace

  TEST(NodeGrid, RunsThroughTheFirstGroupFastest)
  {
    const NodeGrid grid = five_by_four();
    ASSERT_EQ(grid.size(), 20u);
    EXPECT_NEAR((grid.node(0) - Eigen::Vector2d(0., 1.)).norm(), 0., 1e-14);
    EXPECT_NEAR((grid.node(4) - Eigen::Vector2d(4., 1.)).norm(), 0., 1e-14);
    EXPECT_NEAR((grid.node(19) - Eigen::Vector2d(4., 3.)).norm(), 0., 1e-14);
    EXPECT_NEAR((grid.node(6) - Eigen::Vector2d(2. - std::sqrt(2.), 1.5)).norm(), 0., 1e-14);
  }

  TEST(NodeGrid, OfAGroupThatDoesNotChangeHasOneNode)
  {
    const NodeGrid grid({Eigen::Vector2d(2., 7.), Eigen::Vector2d(4., 7.)}, {3, 1});
    EXPECT_EQ(grid.node(1), Eigen::Vector2d(3., 7.));
    const auto left = grid.without({0}, Eigen::Vector2d(3.5, 7.));
    ASSERT_TRUE(left);
    EXPECT_EQ(left->lower, Eigen::Vector2d(3., 7.));
    EXPECT_EQ(left->upper, Eigen::Vector2d(4., 7.));
  }

  TEST(NodeGrid, WithoutAFailedCornerIsShorterByTheLayerThatLosesLeast)
  {
    const auto left = five_by_four().without({19, 18}, Eigen::Vector2d(1., 1.5));
    ASSERT_TRUE(left); // two of five nodes in the last row, one of four in each of two columns
    EXPECT_NEAR((left->lower - Eigen::Vector2d(0., 1.)).norm(), 0., 1e-14);
    EXPECT_NEAR((left->upper - Eigen::Vector2d(4., 2.5)).norm(), 0., 1e-14);
  }

  TEST(NodeGrid, KeepsThePlaceWhateverFails)
  {
    const NodeGrid           grid = five_by_four();
    std::vector<std::size_t> all_but_four;
    for (const std::size_t i : {0, 1, 2, 3, 4, 5, 6, 9, 10, 11, 14, 15, 16, 17, 18, 19})
      all_but_four.push_back(i);
    const Eigen::Vector2d place(2.5, 2.);
    const auto            left = grid.without(all_but_four, place);
    ASSERT_TRUE(left);
    EXPECT_TRUE((left->lower.array() <= place.array()).all() && (left->upper.array() >= place.array()).all());
    EXPECT_NEAR((left->upper - left->lower - Eigen::Vector2d(std::sqrt(2.), 1.)).norm(), 0., 1e-14);
    EXPECT_FALSE(grid.without({7}, place)) << "next to the place";
  }
} // namespace swimtwin
