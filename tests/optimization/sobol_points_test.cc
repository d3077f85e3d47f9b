#include <datasets/system/error.h>
#include <optimization/sobol_points.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace swimtwin
{
  namespace
  {
    TEST(SobolPoints, FirstPointsAreThoseOfTheSequence)
    {
      // Joe and Kuo's table: the first dimensions begin 1/2; 3/4, 1/4; 1/4, 3/4.
      const Eigen::MatrixXd points = sobol_points(Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones(), 3, 0);
      EXPECT_EQ(points.col(0), Eigen::Vector2d(0.5, 0.5));
      EXPECT_EQ(points.col(1), Eigen::Vector2d(0.75, 0.25));
      EXPECT_EQ(points.col(2), Eigen::Vector2d(0.25, 0.75));
    }

    TEST(SobolPoints, EveryCellOfAGridGetsItsShare)
    {
      const Eigen::MatrixXd         points = sobol_points(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), 63, 0);
      std::set<std::pair<int, int>> cells  = {{0, 0}}; // the corner that is left out
      for (const auto &point : points.colwise())
        EXPECT_TRUE(cells.insert({static_cast<int>(8. * point[0]), static_cast<int>(8. * point[1])}).second);
      EXPECT_EQ(cells.size(), 64u);
    }

    TEST(SobolPoints, SeedsShiftThemWithinTheBox)
    {
      const Eigen::Vector2d lower(-1., 10.), upper(1., 30.);
      const Eigen::MatrixXd one = sobol_points(lower, upper, 40, 1), again = sobol_points(lower, upper, 40, 1),
                            two = sobol_points(lower, upper, 40, 2);
      EXPECT_EQ(one, again);
      EXPECT_NE(one, two);
      for (const auto &point : one.colwise())
        EXPECT_TRUE((point.array() >= lower.array()).all() && (point.array() <= upper.array()).all());
    }

    TEST(SobolPoints, InfiniteBoundIsRefused)
    {
      EXPECT_THROW(
          sobol_points(Eigen::Vector2d::Zero(), Eigen::Vector2d(1., std::numeric_limits<double>::infinity()), 4, 0),
          InputError);
    }
  } // namespace
} // namespace swimtwin
