#include <datasets/text/csv_table.h>
#include <datasets/text/toml_document.h>
#include <tests/places.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    const std::filesystem::path reference = std::filesystem::path(places::scenes).parent_path() / "reference";

    /// One value per point: magnetization, modulus -> by increasing frequency.
    using Curves = std::map<std::pair<double, double>, std::vector<double>>;

    struct Extremes
    {
      double lowest = 1e300, highest = -1e300;

      void include(const double value)
      {
        lowest  = std::min(lowest, value);
        highest = std::max(highest, value);
      }
    };

    class StudyFacts : public ::testing::Test
    {
    protected:
      /// The entry `key` of the fact `name`; empty text if there is none.
      const toml::node *entry(const std::string &name, const std::string &key) const
      {
        for (int i = 0; facts.find(fmt::format("fact.{}", i)) != nullptr; ++i)
          if (facts.find(fmt::format("fact.{}.name", i))->value<std::string>() == name)
            return facts.find(fmt::format("fact.{}.{}", i, key));
        ADD_FAILURE() << name;
        return nullptr;
      }
      double number(const std::string &name, const std::string &key) const
      {
        return *entry(name, key)->value<double>();
      }
      std::string verdict(const std::string &name) const { return *entry(name, "verdict")->value<std::string>(); }

      Curves curves_of(const std::string &column) const
      {
        const auto m = points.column("magnetization_A_m"), e = points.column("young_modulus_Pa");
        const auto values = points.column(column);
        Curves     curves;
        for (std::size_t i = 0; i < values.size(); ++i)
          curves[{m[i], e[i]}].push_back(values[i]);
        return curves;
      }

      /// To the digits that the file gives.
      void expect_rounds_to(const double value, const std::string &name, const std::string &key, const int digits) const
      {
        EXPECT_EQ(fmt::format("{:.{}g}", value, digits), fmt::format("{:.{}g}", number(name, key), digits)) << name;
      }

      const TomlDocument facts{read_text_file(reference / "study-facts.toml", "the facts"), "study-facts.toml", {}};
      const CsvTable     points = CsvTable::read(reference / "displacement-frequency.csv");
    };
  } // namespace

  TEST_F(StudyFacts, EveryCurveRisesThenFalls)
  {
    const Curves curves = curves_of("displacement_m");
    ASSERT_EQ(curves.size(), 6u);
    for (const auto &[key, curve] : curves)
    {
      const auto top = std::max_element(curve.begin(), curve.end());
      EXPECT_NE(top, curve.begin());
      EXPECT_NE(top, curve.end() - 1);
      EXPECT_TRUE(std::is_sorted(curve.begin(), top + 1));
      EXPECT_TRUE(std::is_sorted(curve.rbegin(), std::make_reverse_iterator(top)));
    }
    EXPECT_EQ(verdict("rises-then-falls"), "agrees");
  }

  TEST_F(StudyFacts, PeaksLieBelowTheStudys)
  {
    Extremes peaks;
    for (const double peak : CsvTable::read(reference / "peaks.csv").column("peak_Hz"))
      peaks.include(peak);
    expect_rounds_to(peaks.lowest, "peak-near-0.8-Hz", "ours_lowest_Hz", 4);
    expect_rounds_to(peaks.highest, "peak-near-0.8-Hz", "ours_highest_Hz", 4);
    EXPECT_LT(peaks.highest, 0.9 * number("peak-near-0.8-Hz", "study_peak_Hz"));
    EXPECT_EQ(verdict("peak-near-0.8-Hz"), "differs");
  }

  TEST_F(StudyFacts, SofterIsFartherEverywhere)
  {
    Curves   curves = curves_of("displacement_m");
    Extremes ratios;
    for (const double m : {1e5, 2e5})
      for (std::size_t i = 0; i < 10; ++i)
      {
        EXPECT_GT((curves[{m, 5e4}][i]), (curves[{m, 8e4}][i]));
        EXPECT_GT((curves[{m, 8e4}][i]), (curves[{m, 2e5}][i]));
      }
    const CsvTable peaks  = CsvTable::read(reference / "peaks.csv");
    const auto     height = peaks.column("peak_displacement_m"); // 50, 80, 200 kPa at both magnetizations
    ratios.include(height[0] / height[2]);
    ratios.include(height[3] / height[5]);
    expect_rounds_to(ratios.lowest, "softer-is-farther", "ours_lowest_ratio", 3);
    expect_rounds_to(ratios.highest, "softer-is-farther", "ours_highest_ratio", 3);
  }

  TEST_F(StudyFacts, StrokeLoopsAreNearEllipses)
  {
    const CsvTable loops = CsvTable::read(reference / "stroke-loops.csv");
    const auto     phase = loops.column("phase"), head = loops.column("head_angle_rad"),
               tail = loops.column("tail_angle_rad");
    Extremes parts;
    for (std::size_t begin = 0; begin < phase.size(); begin += 100)
    {
      double variance = 0., of_first_harmonic = 0.;
      for (const auto &angle : {head, tail})
      {
        std::complex<double> mean = 0., harmonic = 0.;
        double               square = 0.;
        for (std::size_t i = begin; i < begin + 100; ++i)
        {
          mean += angle[i] / 100.;
          harmonic += std::polar(angle[i] / 100., -2. * std::numbers::pi * phase[i]);
          square += angle[i] * angle[i] / 100.;
        }
        variance += square - std::norm(mean);
        of_first_harmonic += 2. * std::norm(harmonic);
      }
      parts.include(1. - of_first_harmonic / variance);
    }
    EXPECT_LT(parts.highest, number("stroke-loop-near-ellipse", "ours_highest_part"));
    EXPECT_GT(parts.highest, 0.9 * number("stroke-loop-near-ellipse", "ours_highest_part"));
  }

  TEST_F(StudyFacts, LoopAreaGoesWithDisplacementUpToThePeak)
  {
    const auto f = points.column("frequency_Hz"), d = points.column("displacement_m"),
               area = points.column("loop_area_rad2");
    Extremes ratios;
    for (std::size_t i = 0; i < f.size(); ++i)
      if (f[i] < 0.9)
        ratios.include(1e3 * d[i] / std::abs(area[i]));
    expect_rounds_to(ratios.lowest, "loop-area-goes-with-displacement", "ours_lowest_mm_rad2", 4);
    expect_rounds_to(ratios.highest, "loop-area-goes-with-displacement", "ours_highest_mm_rad2", 4);
  }

  TEST_F(StudyFacts, TailAndHeadAtTheEndsOfTheRange)
  {
    Curves head_lag = curves_of("head_lag_rad"), tail_lag = curves_of("tail_lag_rad"),
           swing = curves_of("head_amplitude_rad");
    Extremes behind, swings;
    for (const auto &[key, lag] : head_lag)
    {
      behind.include(tail_lag[key].front() - lag.front());
      swings.include(swing[key].back());
      EXPECT_GT(swing[key].front(), 2.5 * swing[key].back());
    }
    expect_rounds_to(behind.lowest, "tail-hardly-bends-at-low-frequency", "ours_lowest_lag_rad", 2);
    expect_rounds_to(behind.highest, "tail-hardly-bends-at-low-frequency", "ours_highest_lag_rad", 3);
    expect_rounds_to(swings.lowest, "head-cannot-follow-at-high-frequency", "ours_lowest_swing_rad", 3);
    expect_rounds_to(swings.highest, "head-cannot-follow-at-high-frequency", "ours_highest_swing_rad", 3);
  }
} // namespace swimtwin
