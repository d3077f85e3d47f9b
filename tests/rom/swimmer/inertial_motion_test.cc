#include <datasets/system/error.h>
#include <rom/integration/swimmer_integrator.h>
#include <rom/sensitivity/periodic_orbit.h>
#include <rom/swimmer/head_frame.h>
#include <rom/swimmer/reduced_swimmer.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    const SwimmerParameters glycerol{1e5, 1.52, 1e5, 3e4};
    const InertialDensities densities = example_densities({.has_inertia = true});
    const Eigen::Vector2d   inertial_field_T(4e-3, -3e-3);

    struct InertialCase
    {
      const char    *name;
      ExampleOptions options;

      friend void PrintTo(const InertialCase &self, std::ostream *stream) { *stream << self.name; }
    };

    class InertialSwimmers : public ::testing::TestWithParam<InertialCase>
    {
    protected:
      static ReducedModel with_inertia(ExampleOptions options)
      {
        options.has_inertia = true;
        return example_model(options);
      }

      SwimmerState draw(const double largest_radius = 1.4)
      {
        SwimmerState state(swimmer.n_states());
        state << 1e-3 * random(), 1e-3 * random(), 1.5 * random(), random_shape(model, random, largest_radius),
            3e-3 * random(), 3e-3 * random(), 2. * random(), 3e-3 * random.vector(model.n_modes());
        return state;
      }

      VelocityVector rate(const SwimmerState &state, const Eigen::Vector2d &field = inertial_field_T,
                          const SwimmerParameters &values = glycerol) const
      {
        SwimmerMotion motion = swimmer.make_motion();
        swimmer.set_rate(state, field, values, motion);
        return motion.rate;
      }

      RateDerivatives derivatives(const SwimmerState &state) const
      {
        SwimmerMotion   motion = swimmer.make_motion();
        RateDerivatives result = swimmer.make_derivatives();
        swimmer.differentiate(state, inertial_field_T, glycerol, motion, result);
        return result;
      }

      VelocityVector slope(const SwimmerState &state, double SwimmerParameters::*const member) const
      {
        SwimmerParameters after = glycerol, before = glycerol;
        const double      h = 1e-5 * (glycerol.*member);
        after.*member += h;
        before.*member -= h;
        return (rate(state, inertial_field_T, after) - rate(state, inertial_field_T, before)) / (2. * h);
      }

      SwimmerRun run(const ReducedSwimmer &moved, const IntegratorOptions &options = {}) const
      {
        RunRequest request    = example_request(model);
        request.initial_state = state_at_rest(moved);
        return SwimmerIntegrator(moved, options).run(request);
      }

      const ReducedModel   model   = with_inertia(GetParam().options);
      const ReducedSwimmer swimmer = ReducedSwimmer(model, densities);
      RandomNumbers        random  = RandomNumbers(3);
    };

    /// Components have units of their own.
    void expect_slopes(const Eigen::VectorXd &value, const Eigen::VectorXd &reference)
    {
      for (Eigen::Index i = 0; i < value.size(); ++i)
        EXPECT_NEAR(value[i], reference[i], 2e-6 * (std::abs(reference[i]) + 1e-3 * reference.cwiseAbs().maxCoeff()))
            << "component " << i;
    }
  } // namespace

  TEST_P(InertialSwimmers, JacobianIsTheSlopeOfTheRate)
  {
    for (int sample = 0; sample < 10; ++sample)
    {
      const SwimmerState    state    = draw();
      const Eigen::MatrixXd jacobian = derivatives(state).by_state;
      EXPECT_EQ(jacobian.col(0).norm(), 0.);
      for (int k = 1; k < swimmer.n_states(); ++k)
      {
        SwimmerState after = state, before = state;
        const double h = k == 2 ? 1e-5 : k < swimmer.n_velocities() ? 1e-7 : 1e-5; // accelerations are large
        after[k] += h;
        before[k] -= h;
        SCOPED_TRACE(k);
        expect_slopes(jacobian.col(k), (rate(after) - rate(before)) / (2. * h));
      }
    }
  }

  TEST_P(InertialSwimmers, ParameterDerivativesAreSlopes)
  {
    const SwimmerState    state  = draw();
    const RateDerivatives result = derivatives(state);
    expect_slopes(result.by_young_modulus, slope(state, &SwimmerParameters::young_modulus_Pa));
    expect_slopes(result.by_viscosity, slope(state, &SwimmerParameters::viscosity_Pa_s));
    expect_slopes(result.by_magnetization, slope(state, &SwimmerParameters::magnetization_A_m));
    expect_slopes(result.by_tail_magnetization, slope(state, &SwimmerParameters::tail_magnetization_A_m));
    for (int k = 0; k < 2; ++k)
    {
      const Eigen::Vector2d h = 1e-6 * Eigen::Vector2d::Unit(k);
      expect_slopes(result.by_field.col(k),
                    (rate(state, inertial_field_T + h) - rate(state, inertial_field_T - h)) / 2e-6);
    }
  }

  // Inside the trained region and beyond it.
  TEST_P(InertialSwimmers, MagneticPowerIsDissipationAndTheRatesOfElasticAndKineticEnergy)
  {
    SwimmerMotion motion = swimmer.make_motion();
    for (int sample = 0; sample < 20; ++sample)
    {
      const SwimmerState state = draw();
      swimmer.move(state, inertial_field_T, glycerol, motion);
      const double size =
          motion.dissipation_W_m + std::abs(motion.elastic_power_W_m) + std::abs(motion.magnetic_power_W_m);
      EXPECT_NEAR(motion.magnetic_power_W_m,
                  motion.dissipation_W_m + motion.elastic_power_W_m + motion.kinetic_power_W_m, 1e-11 * size);
      // kinetic_power_W_m is what kinetic_energy_J_m does
      constexpr double h     = 1e-8;
      const double     after = swimmer.kinetic_energy_J_m(state + h * motion.rate),
                   before    = swimmer.kinetic_energy_J_m(state - h * motion.rate);
      EXPECT_NEAR((after - before) / (2. * h), motion.kinetic_power_W_m, 1e-5 * size);
      EXPECT_NEAR(motion.kinetic_energy_J_m, swimmer.kinetic_energy_J_m(state), 1e-12 * motion.kinetic_energy_J_m);
    }
  }

  TEST_P(InertialSwimmers, MassIsPositiveDefinite)
  {
    for (int sample = 0; sample < 2000; ++sample)
    {
      const VelocityMatrix M = swimmer.mass(random_shape(model, random, 3.), 3. * random());
      EXPECT_EQ(M.llt().info(), Eigen::Success);
      EXPECT_EQ((M - M.transpose()).norm(), 0.);
    }
  }

  TEST_P(InertialSwimmers, MirroredMotionIsTheMirrorsMotion)
  {
    if (GetParam().options.is_bent)
      GTEST_SKIP() << "the example's resistance has the parity of modes, not of bending coordinates";
    const Eigen::VectorXi parity = model.tail.coordinate_parity();
    Eigen::VectorXd       mirror(swimmer.n_states());
    mirror << 1., -1., -1., parity.cast<double>(), 1., -1., -1., parity.cast<double>();
    const SwimmerState    state = draw();
    const Eigen::VectorXd there = rate(mirror.asDiagonal() * state, {inertial_field_T.x(), -inertial_field_T.y()});
    const Eigen::VectorXd here  = mirror.asDiagonal() * rate(state);
    if (GetParam().options.has_mirror)
      EXPECT_LE((there - here).norm(), 1e-12 * here.norm());
    else
      EXPECT_GE((there - here).norm(), 1e-2 * here.norm());
  }

  // Same motion in the same time: forces and densities scaled together.
  TEST_P(InertialSwimmers, ScalingAllForcesAndDensitiesChangesNothing)
  {
    const ReducedSwimmer    heavy(model,
                                  {4. * densities.fluid_kg_m3, 4. * densities.tail_kg_m3, 4. * densities.head_kg_m3});
    const SwimmerParameters stiff{4e5, 4. * 1.52, 4e5, 12e4};
    const SwimmerState      state  = draw();
    SwimmerMotion           motion = heavy.make_motion();
    heavy.set_rate(state, inertial_field_T, stiff, motion);
    EXPECT_LE((motion.rate - rate(state)).norm(), 1e-12 * motion.rate.norm());
  }

  TEST_P(InertialSwimmers, VanishingDensityGivesTheQuasiStaticMotionToFirstOrder)
  {
    const IntegratorOptions fine{.relative_tolerance = 1e-9};
    const Eigen::Vector3d   still = run(ReducedSwimmer(model), fine).at_period_end.back().head<3>();
    const auto              off   = [&](const double share) {
      const ReducedSwimmer light(
                         model, {share * densities.fluid_kg_m3, share * densities.tail_kg_m3, share * densities.head_kg_m3});
      const SwimmerRun moved = run(light, fine);
      EXPECT_TRUE(moved.completed()) << moved.failure;
      return Eigen::Vector3d(moved.at_period_end.back().head<3>() - still);
    };
    const Eigen::Vector3d tenth = off(.1), twentieth = off(.05);
    EXPECT_GT(tenth.norm(), 1e-7);
    EXPECT_LE((tenth - 2. * twentieth).norm(), .05 * tenth.norm());
  }

  TEST_P(InertialSwimmers, WorkOfAPeriodBalances)
  {
    const SwimmerRun moved = run(swimmer, {.relative_tolerance = 1e-8, .with_work = true});
    ASSERT_TRUE(moved.completed()) << moved.failure;
    for (const PeriodWork &work : moved.work)
    {
      EXPECT_NE(work.kinetic_change, 0.);
      EXPECT_LE(std::abs(work.imbalance()), 1e-5);
    }
  }

  TEST_P(InertialSwimmers, PeriodicMotionIsFoundWithItsVelocities)
  {
    if (model.resistance.depends_on_height)
      GTEST_SKIP() << "a drifting height has no periodic motion of its own";
    RunRequest request        = example_request(model);
    request.initial_state     = run(swimmer).at_period_end.back();
    const PeriodicOrbit orbit = PeriodicOrbitFinder(swimmer).find(request);
    ASSERT_TRUE(orbit.converged()) << orbit.failure;
    request.initial_state        = orbit.start;
    request.n_periods            = 1;
    const SwimmerRun      period = SwimmerIntegrator(swimmer, {}).run(request);
    const Eigen::VectorXd change = period.at_period_end.back() - SwimmerState(orbit.start);
    EXPECT_LE(change.tail(change.size() - 2).norm(), 1e-4);
  }

  INSTANTIATE_TEST_SUITE_P(Inertia, InertialSwimmers,
                           ::testing::Values(InertialCase{"Free", {.depends_on_angle = false}},
                                             InertialCase{"BetweenWalls", {.depends_on_height = true}},
                                             InertialCase{"OffTheAxis", {.has_mirror = false}},
                                             InertialCase{"Bent", {.is_bent = true}}),
                           [](const auto &one) { return one.param.name; });

  TEST(InertialSwimmer, IsRefusedByAModelWithoutInertia)
  {
    EXPECT_THROW(ReducedSwimmer(example_model(), densities), InputError);
    ExampleOptions options;
    options.has_inertia = true;
    EXPECT_THROW(ReducedSwimmer(example_model(options), {0., 0., 7000.}), InputError);
    options.keeps_area = options.has_inertia = true;
    EXPECT_THROW(ReducedSwimmer(example_model(options), densities), InputError);
  }

  TEST(InertialSwimmer, WithFewerModesHasTheLeadingMasses)
  {
    ExampleOptions options;
    options.has_inertia        = true;
    const ReducedModel   model = example_model(options), few = truncated(model, 2);
    const ReducedSwimmer all(model, densities), fewer(few, densities);
    ShapeVector          q = ShapeVector::Zero(4);
    q.head(2) << 5e-4, -3e-4;
    EXPECT_LE((all.mass(q, .3).topLeftCorner(5, 5) - fewer.mass(q.head(2), .3)).norm(), 1e-15 * all.mass(q, .3).norm());
  }
} // namespace swimtwin
