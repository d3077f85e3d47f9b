#include <datasets/observation/observation_set.h>
#include <datasets/text/csv_table.h>
#include <tests/places.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    const std::filesystem::path observations = std::filesystem::path(places::scenes).parent_path() / "observations";

    double in_sigmas(const Observation &point, const double truth_m)
    {
      return (point.displacement_m - truth_m) / point.sigma_m;
    }
  } // namespace

  TEST(ShippedObservations, AreAllReadAndSayThatTheyAreSynthetic)
  {
    int n_sets = 0;
    for (const auto &entry : std::filesystem::directory_iterator(observations))
      if (entry.path().extension() == ".toml")
      {
        const ObservationSet set = read_observations(entry.path());
        EXPECT_TRUE(set.synthetic) << set.name;
        EXPECT_TRUE(set.name.starts_with("synthetic-")) << set.name;
        EXPECT_DOUBLE_EQ(set.field.bx_T(), 5e-3);
        ++n_sets;
      }
    EXPECT_EQ(n_sets, 5);
  }

  TEST(ShippedObservations, CurvesScatterAroundTheirTruthAsStated)
  {
    struct Curve
    {
      const char *name;
      std::size_t n_points;
      double      largest_error;                  ///< relative
      double      least_scatter, largest_scatter; ///< chi-squared: 99.8 % of all draws lie between the two
    };
    for (const auto &[name, n_points, largest_error, least_scatter, largest_scatter] :
         {Curve{"synthetic-soft.csv", 12, 3e-3, 2.2, 32.9}, Curve{"synthetic-stiff.csv", 12, 3e-3, 2.2, 32.9},
          Curve{"synthetic-spatial.csv", 8, 4e-2, 0.86, 26.1}})
    {
      const ObservationSet set = read_observations(observations / name);
      EXPECT_TRUE(set.warnings.empty());
      EXPECT_EQ(set.period, 3);
      ASSERT_EQ(set.points.size(), n_points);
      double chi_squared = 0.;
      for (std::size_t i = 0; i < set.points.size(); ++i)
      {
        const double truth_m = std::stod(set.extra_columns.at("displacement_without_noise_m")[i]);
        const double error_m = std::stod(set.extra_columns.at("numerical_error_m")[i]);
        EXPECT_NEAR(set.points[i].sigma_m, 0.02 * truth_m, 1e-4 * truth_m);
        EXPECT_LT(error_m, largest_error * truth_m) << name << " " << set.points[i].frequency_Hz;
        chi_squared += std::pow(in_sigmas(set.points[i], truth_m), 2);
      }
      EXPECT_GT(chi_squared, least_scatter);
      EXPECT_LT(chi_squared, largest_scatter);
    }
  }

  TEST(ShippedObservations, TracksGiveTheDisplacementBack)
  {
    const ObservationSet set     = read_observations(observations / "synthetic-tracks.csv");
    const CsvTable       truth   = CsvTable::read(observations / "synthetic-tracks-truth.csv");
    const auto           truth_m = truth.column("displacement_m"), n_periods = truth.column("n_periods");
    ASSERT_EQ(set.points.size(), truth_m.size());
    EXPECT_FALSE(set.period);
    EXPECT_TRUE(set.warnings.empty());
    for (std::size_t i = 0; i < truth_m.size(); ++i)
    {
      EXPECT_EQ(set.points[i].n_periods, static_cast<int>(n_periods[i]));
      // The mean of n = 4 is the way from the first end to the last over n: 2 um at both of them, and the
      // interpolation.
      EXPECT_NEAR(set.points[i].displacement_m, truth_m[i], 4. * std::sqrt(2.) * 2e-6 / 4.);
    }
  }

  TEST(ShippedObservations, TrackmateTablesSayTheSameAsTheTracksTheyWereMadeFrom)
  {
    const ObservationSet tracks    = read_observations(observations / "synthetic-tracks.csv");
    const ObservationSet trackmate = read_observations(observations / "synthetic-trackmate.toml");
    ASSERT_EQ(trackmate.points.size(), 2u);
    for (const std::size_t i : {0u, 1u}) // 1 and 1.8 Hz
    {
      EXPECT_EQ(trackmate.points[i].frequency_Hz, tracks.points[i + 2].frequency_Hz);
      EXPECT_NEAR(trackmate.points[i].displacement_m, tracks.points[i + 2].displacement_m,
                  5e-8); // rounded to 0.001 pixels
    }
  }
} // namespace swimtwin
