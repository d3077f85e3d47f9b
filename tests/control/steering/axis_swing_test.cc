#include <control/steering/axis_swing.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr double pi = std::numbers::pi, L = 8e-3, pivot = 0.42 * L, amplitude = 0.2, advance = 1e-4;

    /// A bar that swings about a point on its axis, which goes straight on along -x.
    std::vector<PoseInstant> swinging_bar(const double n_periods)
    {
      std::vector<PoseInstant> instants;
      for (double t = 0.; t <= n_periods; t += 1. / 40.)
      {
        const double          angle = amplitude * std::sin(2. * pi * t);
        const Eigen::Vector2d point(-advance * t, 0.);
        const Eigen::Vector2d head = point - pivot * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        instants.push_back({t, {head, angle}, advance * t});
      }
      return instants;
    }
  } // namespace

  TEST(AxisSwing, IsLeastWhereTheBodyTurnsAboutAndGrowsWithTheDistanceFromThere)
  {
    const Path                   path   = Path::line(1.).placed(pi, {0.5, 0.});
    const std::vector<AxisPoint> points = swing_along_axis(swinging_bar(10.), path, L);
    ASSERT_EQ(points.size(), 21u);
    EXPECT_NEAR(least_swinging(points).behind_m, pivot, 1e-4 * L);
    EXPECT_LE(least_swinging(points).rms_swing_m, 1e-3 * L);
    // |p - mean| of a bar that turns by a: the distance times 2 sin(a / 2), to the second order in the amplitude.
    for (const AxisPoint &point : points)
      EXPECT_NEAR(point.rms_swing_m, std::abs(point.behind_m - pivot) * amplitude / std::sqrt(2.),
                  0.02 * amplitude * L);
  }

  TEST(AxisSwing, NeedsTwoPeriods)
  {
    EXPECT_TRUE(swing_along_axis(swinging_bar(1.5), Path::line(1.), L).empty());
  }
} // namespace swimtwin
