#include <reports/sweep/frequency_curves.h>

#include <reports/sweep/frequency_picture.h>
#include <tests/datasets/temporary_folder.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace swimtwin
{
  namespace
  {
    /// Two stiffnesses and two magnetizations, five frequencies; softer and stronger swim farther.
    std::vector<SweepPoint> sweep_points()
    {
      std::vector<SweepPoint> points;
      for (const double E : {5e4, 2e5})
        for (const double M : {5e4, 1e5})
          for (const double f : {0.2, 0.4, 0.8, 1.6, 3.2})
            points.push_back({E, M, f, M / E * f / (f * f + 0.64) * 1e-4});
      return points;
    }
  } // namespace

  TEST(FrequencyCurves, HoldEveryPointOnceByFrequency)
  {
    const auto curves = frequency_curves(sweep_points());
    ASSERT_EQ(curves.size(), 4u);
    for (const FrequencyCurve &curve : curves)
    {
      EXPECT_EQ(curve.points.size(), 5u);
      EXPECT_TRUE(std::is_sorted(curve.points.begin(), curve.points.end()));
      EXPECT_FALSE(curve.is_ambiguous());
    }
  }

  TEST(FrequencyCurves, DoNotDependOnTheOrderOfTheRows)
  {
    auto       points = sweep_points();
    const auto curves = frequency_curves(points);
    std::shuffle(points.begin(), points.end(), std::mt19937(1));
    const auto again = frequency_curves(points);
    ASSERT_EQ(again.size(), curves.size());
    for (std::size_t k = 0; k < curves.size(); ++k)
    {
      EXPECT_EQ(again[k].name, curves[k].name);
      EXPECT_EQ(again[k].points, curves[k].points);
    }
  }

  TEST(FrequencyCurves, PeakIsFarthestAlsoBackwards)
  {
    const FrequencyCurve curve{"", {{0.2, 1e-4}, {0.8, -3e-4}, {1.6, 2e-4}}};
    EXPECT_EQ(curve.peak(), (CurvePoint{0.8, -3e-4}));
    EXPECT_FALSE(curve.peaks_at_its_end());
    EXPECT_TRUE((FrequencyCurve{"", {{0.2, 1e-4}, {0.8, 3e-4}}}).peaks_at_its_end());
    for (const FrequencyCurve &peaked : frequency_curves(sweep_points()))
      EXPECT_EQ(peaked.peak().frequency_Hz, 0.8); // f / (f^2 + 0.8^2) is largest at 0.8
  }

  TEST(FrequencyCurves, NameTheMagnetizationOnlyWhereItVaries)
  {
    auto points = sweep_points();
    EXPECT_EQ(frequency_curves(points).front().name, "E = 50000 Pa, M = 50000 A/m");
    std::erase_if(points, [](const SweepPoint &point) { return point.magnetization_A_m != 1e5; });
    EXPECT_EQ(frequency_curves(points).front().name, "E = 50000 Pa");
  }

  TEST(FrequencyCurves, TwoPointsAtOneFrequencyAreAmbiguous)
  {
    EXPECT_TRUE(frequency_curves({{1e5, 0., 1., 1e-4}, {1e5, 0., 1., 2e-4}}).front().is_ambiguous());
  }

  TEST(FrequencyPicture, IsDrawnAndTellsTheFarthest)
  {
    const auto picture = frequency_picture(frequency_curves(sweep_points()), "study");
    const auto caption = std::find_if(picture.variables.begin(), picture.variables.end(),
                                      [](const auto &variable) { return variable.first == "caption"; });
    ASSERT_NE(caption, picture.variables.end());
    expect_in(caption->second, "at 0.8 Hz with E = 50000 Pa, M = 100000 A/m");
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    for (const std::size_t n_points : {20u, 5u, 1u}) // four curves, one curve, a single point
    {
      auto points = sweep_points();
      points.resize(n_points);
      write_gnuplot_files(folder.path, frequency_picture(frequency_curves(points), "study"), "test");
      EXPECT_EQ(content(draw_png(folder.path, "displacement_frequency")).substr(0, 4), "\x89PNG");
    }
  }
} // namespace swimtwin
