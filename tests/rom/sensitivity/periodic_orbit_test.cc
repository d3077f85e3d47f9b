#include <rom/sensitivity/periodic_orbit.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    class Orbits : public ::testing::TestWithParam<bool>
    {
    protected:
      const ReducedModel   model   = example_model({.keeps_area = GetParam()});
      const ReducedSwimmer swimmer = ReducedSwimmer(model);
      RunRequest           request = example_request(model);
    };
  } // namespace

  TEST_P(Orbits, AreTheLimitOfManyPeriods)
  {
    const PeriodicOrbit orbit =
        PeriodicOrbitFinder(swimmer, {.relative_tolerance = 1e-9, .closure = 1e-8}).find(request);
    ASSERT_TRUE(orbit.converged()) << orbit.failure;
    EXPECT_TRUE(orbit.is_stable());
    EXPECT_LE(orbit.n_newton_steps, 8);
    request.n_periods     = 60;
    const SwimmerRun run  = SwimmerIntegrator(swimmer, {.relative_tolerance = 1e-9}).run(request);
    const double     last = displacement_per_period(run, 0.).back();
    EXPECT_NEAR(orbit.displacement_m(0.), last, 1e-4 * std::abs(last));
    EXPECT_NEAR(orbit.start[2], run.at_period_end.back()[2], 1e-5);
  }

  // Between walls that are felt the motion is that at the height where it is asked for.
  TEST(OrbitsBetweenWalls, AreThoseAtTheHeightOfTheRequest)
  {
    const ReducedModel   model = example_model({.depends_on_height = true});
    const ReducedSwimmer swimmer(model);
    PeriodicOrbitFinder  finder(swimmer, {.relative_tolerance = 1e-9, .closure = 1e-8});
    RunRequest           request = example_request(model);
    request.initial_state[1]     = 4e-4;
    const PeriodicOrbit above    = finder.find(request);
    ASSERT_TRUE(above.converged()) << above.failure;
    EXPECT_EQ(above.start[1], 4e-4);
    request.initial_state  = above.start;
    request.n_periods      = 1;
    const SwimmerState end = SwimmerIntegrator(swimmer, {.relative_tolerance = 1e-9}).run(request).at_period_end.back();
    EXPECT_LE((end - above.start).tail(model.n_modes()).norm(), 1e-7 * swimmer.length_m());
    EXPECT_LE((end.head<2>() - above.start.head<2>() - above.drift_m).norm(), 1e-7 * swimmer.length_m());
    request.initial_state[1]     = 0.;
    const PeriodicOrbit at_usual = finder.find(request);
    EXPECT_GT(std::abs(above.displacement_m(0.) - at_usual.displacement_m(0.)),
              1e-3 * std::abs(at_usual.displacement_m(0.)));
  }

  TEST_P(Orbits, DefaultToleranceIsFarBelowTheModelsError)
  {
    const PeriodicOrbit coarse = PeriodicOrbitFinder(swimmer).find(request);
    const PeriodicOrbit fine =
        PeriodicOrbitFinder(swimmer, {.relative_tolerance = 1e-10, .closure = 1e-9}).find(request);
    ASSERT_TRUE(coarse.converged() && fine.converged());
    EXPECT_NEAR(coarse.displacement_m(0.), fine.displacement_m(0.), 5e-4 * std::abs(fine.displacement_m(0.)));
  }

  TEST_P(Orbits, MultipliersAreTheRateAtWhichDisturbancesFade)
  {
    PeriodicOrbitFinder finder(swimmer, {.relative_tolerance = 1e-9, .closure = 1e-8});
    const PeriodicOrbit orbit = finder.find(request);
    ASSERT_TRUE(orbit.converged());
    ASSERT_EQ(orbit.floquet_multipliers.size(), GetParam() ? 4u : 5u);
    RunRequest disturbed    = request;
    disturbed.initial_state = orbit.start;
    disturbed.initial_state[2] += 1e-3;
    disturbed.n_periods        = 6;
    const SwimmerRun run       = SwimmerIntegrator(swimmer, {.relative_tolerance = 1e-10}).run(disturbed);
    const auto       deviation = [&](const std::size_t i) { return run.at_period_end[i][2] - orbit.start[2]; };
    const double     slowest   = std::abs(orbit.floquet_multipliers.front());
    EXPECT_NEAR(deviation(4) / deviation(3), slowest, 0.02 * slowest);
  }

  TEST_P(Orbits, DriftHasItsSensitivities)
  {
    OrbitOptions options{.relative_tolerance = 1e-11, .closure = 1e-9};
    options.parameters             = {{Quantity::viscosity, 0}, {Quantity::frequency, 0}, {Quantity::field, 0}};
    const Eigen::RowVectorXd found = PeriodicOrbitFinder(swimmer, options).find(request).displacement_sensitivity(0.);
    ASSERT_EQ(found.size(), 3);
    options.parameters.clear();
    PeriodicOrbitFinder finder(swimmer, options);
    const auto          slope = [&](double &value) {
      const double centre = value, h = 2e-3 * centre;
      const auto   at = [&](const double moved) {
        value = moved;
        return finder.find(request).displacement_m(0.);
      };
      const double difference = (at(centre + h) - at(centre - h)) / (2. * h);
      value                   = centre;
      return difference;
    };
    const double slopes[] = {slope(request.parameters.viscosity_Pa_s), slope(request.drive.frequency_Hz),
                             slope(request.drive.parameters[0])};
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(found[i], slopes[i], 1e-4 * std::abs(slopes[i])) << i;
  }

  TEST_P(Orbits, WithoutAFieldTheHeadingIsNeutral)
  {
    request.drive.parameters.setZero();
    const ReducedModel   open_model = example_model({.depends_on_angle = false, .keeps_area = GetParam()});
    const ReducedSwimmer open(open_model);
    const PeriodicOrbit  orbit = PeriodicOrbitFinder(open).find(request);
    EXPECT_EQ(orbit.status, OrbitStatus::neutral_heading);
    EXPECT_NE(orbit.failure.find("neutral"), std::string::npos);
  }

  INSTANTIATE_TEST_SUITE_P(OpenAndClosed, Orbits, ::testing::Bool(),
                           [](const auto &instance) { return instance.param ? "closed" : "open"; });
} // namespace swimtwin
