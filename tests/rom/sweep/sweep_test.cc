#include <datasets/reduced/held_out_error.h>
#include <datasets/system/error.h>
#include <rom/sweep/sweep.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

#include <cstring>

namespace swimtwin
{
  namespace
  {
    bool same_bits(const double a, const double b)
    {
      return std::memcmp(&a, &b, sizeof a) == 0;
    }

    class Sweeps : public ::testing::Test
    {
    protected:
      const ReducedModel model   = example_model({.magnetic_tail = false});
      SweepOptions       options = [this] {
        SweepOptions defaults;
        defaults.base = example_request(model);
        return defaults;
      }();
    };
  } // namespace

  TEST_F(Sweeps, CombineTheAxesWithTheFrequencyFastest)
  {
    SweepAxes axes;
    axes.young_modulus_Pa = {5e4, 2e5};
    axes.frequency_Hz     = {0.5, 1., 2.};
    const auto results    = sweep(model, axes, options);
    ASSERT_EQ(results.size(), 6u);
    EXPECT_EQ(results[1].member.frequency_Hz, 1.);
    EXPECT_EQ(results[1].member.parameters.young_modulus_Pa, 5e4);
    EXPECT_EQ(results[3].member.parameters.young_modulus_Pa, 2e5);
    EXPECT_EQ(results[3].member.parameters.viscosity_Pa_s, 1.52);
    EXPECT_EQ(results[3].member.by_T, 5e-3);
  }

  TEST_F(Sweeps, MembersAreRuns)
  {
    SweepAxes axes;
    axes.frequency_Hz           = {1.1};
    const SweepResult    result = sweep(model, axes, options).front();
    const ReducedSwimmer swimmer(model);
    RunRequest           request   = options.base;
    request.drive.frequency_Hz     = 1.1;
    const SwimmerRun run           = SwimmerIntegrator(swimmer, {}).run(request);
    const auto       displacements = displacement_per_period(run, 0.);
    EXPECT_EQ(result.displacement_m, displacements[2]);
    const ReducedSwimmer two(truncated(model, 2));
    request.initial_state = state_at_rest(two);
    const double fewer    = displacement_per_period(SwimmerIntegrator(two, {}).run(request), 0.)[2];
    EXPECT_EQ(result.error_indicator_m, std::abs(displacements[2] - fewer));
    const PeriodicOrbit orbit = PeriodicOrbitFinder(swimmer, {.relative_tolerance = 1e-9, .closure = 1e-8}).find([&] {
      RunRequest rest         = options.base;
      rest.drive.frequency_Hz = 1.1;
      return rest;
    }());
    EXPECT_NEAR(result.periodic_displacement_m, orbit.displacement_m(0.), 1e-3 * std::abs(orbit.displacement_m(0.)));
  }

  TEST_F(Sweeps, StateWithinWhatTheFullOrderModelIsByHeldOutRunsAndHalfFits)
  {
    SweepAxes axes;
    axes.frequency_Hz        = {1.1};
    ReducedModel      halved = model;
    const SweepResult before = sweep(halved, axes, options).front();
    EXPECT_EQ(before.fit_change_m, 0.);
    EXPECT_EQ(before.error_95_m, error_bound_m(model.record, {before.displacement_m, 0.}));
    EXPECT_EQ(before.trust.bound, "");

    const Eigen::MatrixXd &c    = model.resistance.coefficients;
    halved.resistance.half_fits = {.9 * c, 1.1 * c};
    const auto with             = [&](const Eigen::MatrixXd &coefficients) {
      ReducedModel other            = model;
      other.resistance.coefficients = coefficients;
      return sweep(other, axes, options).front().displacement_m;
    };
    const SweepResult result = sweep(halved, axes, options).front();
    EXPECT_EQ(result.displacement_m, before.displacement_m);
    EXPECT_EQ(result.fit_change_m, .5 * std::abs(with(.9 * c) - with(1.1 * c)));
    EXPECT_GT(result.error_95_m, before.error_95_m);
    halved.resistance.half_fits = {.2 * c, 1.8 * c};
    EXPECT_NE(sweep(halved, axes, options).front().trust.text().find("% (95 %)"), std::string::npos);
    halved.record.held_out_runs.clear();
    EXPECT_TRUE(std::isnan(sweep(halved, axes, options).front().error_95_m));
  }

  TEST_F(Sweeps, AreTheSameToTheLastBitForAnyNumberOfThreads)
  {
    SweepAxes axes;
    axes.young_modulus_Pa = {5e4, 2e5};
    for (int i = 1; i <= 10; ++i)
      axes.frequency_Hz.push_back(0.3 * i);
    options.n_threads = 1;
    const auto one    = sweep(model, axes, options);
    for (const int n_threads : {2, 5})
    {
      options.n_threads = n_threads;
      const auto many   = sweep(model, axes, options);
      ASSERT_EQ(many.size(), one.size());
      for (std::size_t i = 0; i < one.size(); ++i)
      {
        EXPECT_EQ(many[i].member.frequency_Hz, one[i].member.frequency_Hz);
        EXPECT_TRUE(same_bits(many[i].displacement_m, one[i].displacement_m)) << i;
        EXPECT_TRUE(same_bits(many[i].periodic_displacement_m, one[i].periodic_displacement_m)) << i;
        EXPECT_TRUE(same_bits(many[i].error_indicator_m, one[i].error_indicator_m)) << i;
        EXPECT_TRUE(same_bits(many[i].largest_multiplier, one[i].largest_multiplier)) << i;
      }
    }
  }

  TEST_F(Sweeps, FlagWhatIsOutsideTheTrainedRange)
  {
    SweepAxes axes;
    axes.young_modulus_Pa = {1e4, 1e5, 1e6};
    axes.by_T             = {5e-3, 6e-3};
    const auto results    = sweep(model, axes, options);
    EXPECT_EQ(results[0].trust.text(),
              "E/(M by) = 20 below 40; E/(mu f) = 8224 below 8772; young_modulus_Pa = 1e+04 below 4e+04");
    EXPECT_TRUE(results[2].trust.inside());
    EXPECT_EQ(results[3].trust.text(), "bx/by = 0.8333 below 1; by_T = 0.006 above 0.005");
    EXPECT_EQ(results[4].trust.outside_range.size(), 2u);
    EXPECT_EQ(results[5].trust.outside_range.size(), 4u);
  }

  TEST_F(Sweeps, FlagAParameterOutsideItsRangeAndSayWhenATrainedRunMovesAlike)
  {
    SweepAxes axes;
    axes.young_modulus_Pa  = {1e5 * 10.};
    axes.viscosity_Pa_s    = {model.range.viscosity_Pa_s.low * 10.};
    axes.magnetization_A_m = {model.range.magnetization_A_m.low * 10.};
    const std::string text = sweep(model, axes, options).front().trust.text();
    EXPECT_NE(text.find("young_modulus_Pa = 1e+06 above"), std::string::npos) << text;
    EXPECT_NE(text.find("; a trained run has the same ratios"), std::string::npos) << text;
    EXPECT_EQ(text.find("E/("), std::string::npos) << text;
  }

  TEST_F(Sweeps, FlagShapesAndAnglesThatLeaveTheTrainedRegion)
  {
    ReducedModel narrow = model;
    narrow.resistance.coordinate_scale_m *= 0.05;
    narrow.resistance.angle_scale_rad = 0.1;
    const SweepResult result          = sweep(narrow, {}, options).front();
    ASSERT_EQ(result.trust.outside_region.size(), 2u);
    EXPECT_NE(result.trust.text().find("times the trained region's radius"), std::string::npos);
    EXPECT_TRUE(std::isfinite(result.displacement_m));
  }

  TEST_F(Sweeps, SayWhyThereIsNoPeriodicMotion)
  {
    const ReducedModel open = example_model({.depends_on_angle = false, .magnetic_tail = false});
    SweepAxes          axes;
    axes.magnetization_A_m   = {0.};
    const SweepResult result = sweep(open, axes, options).front();
    EXPECT_EQ(result.displacement_m, 0.);
    EXPECT_TRUE(std::isnan(result.periodic_displacement_m));
    EXPECT_NE(result.note.find("heading is neutral"), std::string::npos);
  }

  TEST_F(Sweeps, HandBackWhatIsImpossible)
  {
    SweepAxes axes;
    axes.viscosity_Pa_s = {1.5, -1.};
    options.n_threads   = 2;
    EXPECT_THROW(sweep(model, axes, options), InputError);
  }

  TEST_F(Sweeps, HaveNoIndicatorWithOneMode)
  {
    options.base.initial_state = SwimmerState::Zero(4);
    const SweepResult result   = sweep(truncated(model, 1), {}, options).front();
    EXPECT_TRUE(std::isfinite(result.displacement_m));
    EXPECT_TRUE(std::isnan(result.error_indicator_m));
  }

  TEST(Comparison, UsesTwoModesFewerButAtLeastOne)
  {
    EXPECT_EQ(n_modes_of_comparison(6), 4);
    EXPECT_EQ(n_modes_of_comparison(3), 1);
    EXPECT_EQ(n_modes_of_comparison(2), 1);
    EXPECT_EQ(n_modes_of_comparison(1), 1);
  }
} // namespace swimtwin
