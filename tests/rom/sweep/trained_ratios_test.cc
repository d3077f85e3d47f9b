#include <rom/integration/swimmer_integrator.h>
#include <rom/sweep/trained_ratios.h>
#include <tests/rom/example_model.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace swimtwin
{
  namespace
  {
    const TrainedRange range = {{4e4, 3e5}, {1.2, 1.6}, {1e5, 2e5}, {0.1, 3.}, {4e-3, 6e-3}, {3e-3, 7e-3}};

    RunRequest request(const SwimmerParameters &parameters, const double f, const double bx, const double by)
    {
      RunRequest request;
      request.parameters         = parameters;
      request.drive.field        = std::make_shared<SinusoidalField>();
      request.drive.parameters   = Eigen::Vector2d(bx, by);
      request.drive.frequency_Hz = f;
      return request;
    }

    std::string notes(const RunRequest &request)
    {
      return fmt::format("{}", fmt::join(notes_outside_range(range, request), "; "));
    }

    /// The same motion: all forces, the viscous one through the frequency, times `force`; the field times `field`, the
    /// magnetization that much less.
    RunRequest equivalent(RunRequest request, const double force, const double field)
    {
      request.parameters.young_modulus_Pa *= force;
      request.parameters.magnetization_A_m *= force / field;
      request.drive.frequency_Hz *= force;
      request.drive.parameters *= field;
      return request;
    }
  } // namespace

  TEST(TrainedRatios, IsOfTheMotionNotOfSingleParameters)
  {
    const RunRequest trained = request({1e5, 1.4, 1.5e5, 0.}, 0.8, 5e-3, 5e-3);
    for (const double force : {1e-3, 0.1, 1., 50.})
      for (const double field : {0.01, 1., 30.})
        EXPECT_EQ(notes(equivalent(trained, force, field)), "") << force << " " << field;
    RunRequest thick = trained; // E, mu and M together
    thick.parameters.young_modulus_Pa *= 40.;
    thick.parameters.viscosity_Pa_s *= 40.;
    thick.parameters.magnetization_A_m *= 40.;
    EXPECT_EQ(notes(thick), "");
  }

  TEST(TrainedRatios, HoldsExactlyWhereATrainedRunIsEquivalent)
  {
    // Random runs near the range; an equivalent trained one is looked for on a fine grid of both factors.
    std::mt19937_64                        engine(3);
    std::uniform_real_distribution<double> decade(-0.6, 0.6);
    const auto around = [&](const double value) { return value * std::pow(10., decade(engine)); };
    const auto within = [](const Interval &trained, const double value, const double slack) {
      return value >= trained.low * (1. - slack) && value <= trained.high * (1. + slack);
    };
    const auto has_equivalent = [&](const RunRequest &run, const double slack) {
      for (double force = -2.5; force <= 2.5; force += 0.02)
        for (double field = -1.; field <= 1.; field += 0.02)
        {
          const RunRequest e  = equivalent(run, std::pow(10., force), std::pow(10., field));
          const double     mu = e.parameters.viscosity_Pa_s, f = e.drive.frequency_Hz;
          if (within(range.young_modulus_Pa, e.parameters.young_modulus_Pa, slack) &&
              within(range.magnetization_A_m, e.parameters.magnetization_A_m, slack) &&
              within({range.viscosity_Pa_s.low * range.frequency_Hz.low,
                      range.viscosity_Pa_s.high * range.frequency_Hz.high},
                     mu * f, slack) &&
              within(range.bx_T, e.drive.parameters[0], slack) && within(range.by_T, e.drive.parameters[1], slack))
            return true;
        }
      return false;
    };
    int n_inside = 0, n_outside = 0;
    for (int i = 0; i < 60; ++i)
    {
      const RunRequest run =
          request({around(1e5), around(1.4), around(1.4e5), 0.}, around(0.6), around(5e-3), around(5e-3));
      const bool inside = notes(run).empty();
      (inside ? n_inside : n_outside) += 1;
      if (inside)
        EXPECT_TRUE(has_equivalent(run, 0.05)) << i; // half a cell of both factors
      else
        EXPECT_FALSE(has_equivalent(run, 0.)) << i << " " << notes(run);
    }
    EXPECT_GT(n_inside, 5);
    EXPECT_GT(n_outside, 5);
  }

  TEST(TrainedRatios, NamesTheRatiosThatWereNotTrainedThenTheParameters)
  {
    const SwimmerParameters p = {1e5, 1.4, 1.5e5, 0.};
    EXPECT_EQ(
        notes(request({1e7, 1.4, 1.5e5, 0.}, 2., 5e-3, 5e-3)),
        "E/(M by) = 1.333e+04 above 750; E/(mu f) = 3.571e+06 above 2.5e+06; young_modulus_Pa = 1e+07 above 3e+05");
    EXPECT_EQ(notes(request({1e3, 1.4, 1.5e5, 0.}, 0.01, 5e-3, 5e-3)).substr(0, 18), "E/(M by) = 1.333 b");
    EXPECT_EQ(notes(request(p, 300., 5e-3, 5e-3)),
              "E/(mu f) = 238.1 below 8333; M by/(mu f) = 1.786 below 83.33; frequency_Hz = 300 above 3");
    EXPECT_EQ(notes(request(p, 0.8, 1e-3, 5e-3)), "bx/by = 0.2 below 0.5714; bx_T = 0.001 below 0.004");
    EXPECT_EQ(notes(request(p, 0.8, -5e-3, 5e-3)), "bx_T = -0.005 below 0.004");
    EXPECT_EQ(notes(request({1e5, 1.4, 0., 0.}, 0.8, 5e-3, 5e-3)), "magnetization_A_m = 0 below 1e+05");
  }

  TEST(TrainedRatios, OfAMagnetisedTailKeepsTheMagnetization)
  {
    const RunRequest trained = request({1e5, 1.4, 1.5e5, 2e4}, 0.8, 5e-3, 5e-3);
    EXPECT_EQ(notes(trained), "");
    RunRequest stronger = trained; // all forces twice, by the field
    stronger.parameters.young_modulus_Pa *= 6.;
    stronger.drive.frequency_Hz *= 6.;
    stronger.drive.parameters *= 6.;
    EXPECT_EQ(notes(stronger), "");
    EXPECT_EQ(notes(equivalent(trained, 6., 1.)).substr(0, 27), "M = 9e+05 above 2e+05; E/bx");
  }

  TEST(TrainedRatios, OfAnyOtherFieldComparesTheRest)
  {
    RunRequest run       = request({1e5, 1.4, 1.5e5, 0.}, 0.8, 5e-3, 5e-3);
    run.drive.field      = std::make_shared<PiecewiseLinearField>(std::vector<double>{0., 0.5});
    run.drive.parameters = Eigen::Vector4d(1., 2., 3., 4.);
    EXPECT_EQ(notes(run), "");
    run.parameters.magnetization_A_m = 1e3;
    EXPECT_EQ(notes(run), "E/M = 100 above 3; M/(mu f) = 892.9 below 2.083e+04; magnetization_A_m = 1000 below 1e+05");
  }

  TEST(TrainedRatios, AModelGivesEquivalentRunsTheSameMotion)
  {
    const ReducedModel   model = example_model({.magnetic_tail = false});
    const ReducedSwimmer swimmer(model);
    SwimmerIntegrator    integrator(swimmer, {.relative_tolerance = 1e-9});
    const RunRequest     run      = example_request(model);
    const double         D        = displacement_per_period(integrator.run(run), 0.)[2];
    const double         of_other = displacement_per_period(integrator.run(equivalent(run, 7., 0.3)), 0.)[2];
    EXPECT_NEAR(of_other, D, 1e-6 * std::abs(D));
  }
} // namespace swimtwin
