#include <control/steering/path.h>
#include <datasets/system/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {

    std::string refusal(const Path &path, const double lever_m)
    {
      try
      {
        require_followable(path, lever_m);
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "";
    }
  } // namespace

  TEST(Path, CircleAndSquareHaveTheirLengthsAndTurnLeft)
  {
    const Path circle = Path::circle(8e-3), square = Path::square(16e-3);
    EXPECT_NEAR(circle.length_m(), 2. * std::numbers::pi * 8e-3, 1e-4 * circle.length_m());
    EXPECT_NEAR(square.length_m(), 64e-3, 1e-15);
    EXPECT_NEAR(circle.heading_rad(circle.length_m()) - circle.heading_rad(0.), 2. * std::numbers::pi, 0.02);
    EXPECT_NEAR(square.heading_rad(63e-3), 1.5 * std::numbers::pi, 1e-12);
    EXPECT_NEAR((circle.at(0.25 * circle.length_m()).point_m - Eigen::Vector2d(8e-3, 8e-3)).norm(), 0., 1e-6);
  }

  TEST(Path, FigureEightTurnsBackAndComesHome)
  {
    const Path eight = Path::figure_eight(8e-3);
    EXPECT_NEAR(eight.length_m(), 4. * std::numbers::pi * 8e-3, 1e-4 * eight.length_m());
    EXPECT_NEAR(eight.at(eight.length_m()).point_m.norm(), 0., 1e-12);
    EXPECT_NEAR(eight.heading_rad(eight.length_m()), 0., 0.02);
  }

  TEST(Path, NearestPlaceIsTheFootOfThePerpendicularOrACorner)
  {
    const Path      square = Path::square(1.);
    const PathPlace foot = square.nearest({0.4, -0.2}, 0., 2.), corner = square.nearest({1.1, -0.1}, 0., 2.);
    EXPECT_NEAR(foot.arc_m, 0.4, 1e-15);
    EXPECT_FALSE(foot.at_corner);
    EXPECT_NEAR(corner.arc_m, 1., 1e-15);
    EXPECT_TRUE(corner.at_corner);
    EXPECT_EQ(corner.tangent.y(), 1.); // ahead, not behind
  }

  TEST(Path, NearestPlaceStaysInTheStretchThatIsAskedFor)
  {
    const Path eight = Path::figure_eight(1.);
    EXPECT_LE(eight.nearest({0., 0.}, 0., 1.).arc_m, 1e-12);
    EXPECT_NEAR(eight.nearest({0., 0.}, 5., 7.).arc_m, 2. * std::numbers::pi, 1e-3);
  }

  TEST(Path, PlacingKeepsItsShape)
  {
    const Path placed = Path::square(1.).placed(0.5 * std::numbers::pi, {2., 3.});
    EXPECT_NEAR((placed.at(0.5).point_m - Eigen::Vector2d(2., 3.5)).norm(), 0., 1e-14);
    EXPECT_NEAR(placed.first(1.5).length_m(), 1.5, 1e-14);
  }

  TEST(Path, WhoIsLedOnACircleSettlesWhereTheSineOfTheOffsetIsLeverOverRadius)
  {
    const PathRequirement need = path_requirement(Path::circle(8e-3), 3.2e-3, 0.);
    EXPECT_TRUE(need.can_be_followed);
    EXPECT_NEAR(std::sin(need.largest_offset_rad), 0.4, 0.01);
  }

  /// The body has not turned from the first corner when it comes to the second.
  TEST(Path, RightAnglesCanBeFollowedIfTheyLieApart)
  {
    EXPECT_EQ(refusal(Path::square(16e-3), 3.2e-3), "");
    const std::string message = refusal(Path::square(4e-3), 3.2e-3);
    EXPECT_NE(message.find("turns more tightly 0.008"), std::string::npos) << message;
    EXPECT_NE(message.find("keep corners at most right angles"), std::string::npos);
  }

  TEST(Path, CirclesInsideTheLeverAndSharpCornersAreRefused)
  {
    EXPECT_NE(refusal(Path::circle(2.5e-3), 3.2e-3), "");
    EXPECT_EQ(refusal(Path::circle(3.4e-3), 3.2e-3), "");
    EXPECT_NE(refusal(Path::through({{0., 0.}, {1., 0.}, {0.2, 0.5}}), 1e-2), "");
  }

  TEST(Path, RefusesWhatIsNoPath)
  {
    EXPECT_THROW(Path::circle(0.), InputError);
    EXPECT_THROW(Path::square(-1.), InputError);
    EXPECT_THROW(Path::through({{1., 1.}, {1., 1.}}), InputError);
    EXPECT_THROW(Path::through({{1., 1.}, {NAN, 1.}}), InputError);
  }

  TEST(Paths, DirectionOfACircleIsLinearInItsArc)
  {
    const Path circle = Path::circle(2.).placed(0.7, {1., 0.});
    for (const double share : {0., 0.1234, 0.5, 0.77777, 1.})
      EXPECT_NEAR(circle.direction_rad(share * circle.length_m()), 0.7 + 2. * std::numbers::pi * share, 1e-9);
    const Path square = Path::square(1.);
    EXPECT_DOUBLE_EQ(square.direction_rad(0.999), 0.);
    EXPECT_DOUBLE_EQ(square.direction_rad(1.001), std::numbers::pi / 2.);
  }

  TEST(Paths, TheFrontOfAPointOnACircleGoesOnAWiderOne)
  {
    const Path   front = Path::circle(2.).of_front(1.5);
    const double wider = 2.5; // sqrt(2^2 + 1.5^2)
    for (const Eigen::Vector2d &point : front.points_m())
      EXPECT_NEAR((point - Eigen::Vector2d(-1.5, 2.)).norm(), wider, 1e-12);
    EXPECT_NEAR(front.heading_rad(0.), std::atan2(1.5, 2.), 0.01);
    EXPECT_THROW(Path::square(1.).of_front(0.1), InputError);
  }
} // namespace swimtwin
