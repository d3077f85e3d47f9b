#include <datasets/system/error.h>
#include <rom/integration/swimmer_integrator.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    SwimmerRun run_of(const ReducedSwimmer &swimmer, const RunRequest &request, const IntegratorOptions &options = {})
    {
      return SwimmerIntegrator(swimmer, options).run(request);
    }

    double last_displacement(const SwimmerRun &run)
    {
      return displacement_per_period(run, 0.).back();
    }

    class Runs : public ::testing::TestWithParam<bool>
    {
    protected:
      const ReducedModel   model   = example_model({.keeps_area = GetParam()});
      const ReducedSwimmer swimmer = ReducedSwimmer(model);
      RunRequest           request = example_request(model);
    };

    /// The request with one of its numbers changed.
    RunRequest shifted(RunRequest request, const Parameter &parameter, const double by)
    {
      switch (parameter.quantity)
      {
      case Quantity::young_modulus:
        request.parameters.young_modulus_Pa += by;
        break;
      case Quantity::viscosity:
        request.parameters.viscosity_Pa_s += by;
        break;
      case Quantity::magnetization:
        request.parameters.magnetization_A_m += by;
        break;
      case Quantity::tail_magnetization:
        request.parameters.tail_magnetization_A_m += by;
        break;
      case Quantity::frequency:
        request.drive.frequency_Hz += by;
        break;
      case Quantity::field:
        request.drive.parameters[parameter.index] += by;
        break;
      case Quantity::initial_angle:
        request.initial_state[2] += by;
        break;
      case Quantity::initial_shape:
        request.initial_state[3 + parameter.index] += by;
        break;
      case Quantity::initial_velocity:
        request.initial_state[request.initial_state.size() / 2 + parameter.index] += by;
        break;
      }
      return request;
    }

    struct Differentiated
    {
      Parameter parameter;
      double    step = 0.;
    };
  } // namespace

  TEST_P(Runs, SwimAndStayNearTheTrainedShapes)
  {
    const SwimmerRun run = run_of(swimmer, request);
    ASSERT_TRUE(run.completed()) << run.failure;
    EXPECT_EQ(run.at_period_end.size(), 4u);
    EXPECT_GT(std::abs(last_displacement(run)), 1e-6);
    EXPECT_GT(run.largest_shape_radius, 0.01);
    EXPECT_LT(run.largest_shape_radius, 1.);
  }

  TEST_P(Runs, DoNotDependOnTheRunsBefore)
  {
    SwimmerIntegrator integrator(swimmer, {.sensitivities = {{Quantity::viscosity, 0}}});
    const SwimmerRun  first  = integrator.run(request);
    RunRequest        other  = request;
    other.drive.frequency_Hz = 2.7;
    integrator.run(other);
    const SwimmerRun again = integrator.run(request);
    EXPECT_EQ(again.at_period_end.back(), first.at_period_end.back());
    EXPECT_EQ(again.sensitivity_at_period_end.back(), first.sensitivity_at_period_end.back());
  }

  TEST_P(Runs, DefaultToleranceIsFarBelowTheModelsError)
  {
    const double coarse = last_displacement(run_of(swimmer, request));
    const double fine   = last_displacement(run_of(swimmer, request, {.relative_tolerance = 1e-11}));
    EXPECT_NEAR(coarse, fine, 5e-4 * std::abs(fine));
  }

  TEST_P(Runs, SensitivitiesAreCentralDifferences)
  {
    request.n_periods                         = 1; // later, the initial state is forgotten
    request.parameters.tail_magnetization_A_m = 2e4;
    request.initial_state[2]                  = 0.1;
    request.initial_state[3]                  = 1e-5;
    // Steps of about a hundredth: runs differ by round-off in their steps, some 1e-10 relative, which differences
    // magnify.
    std::vector<Differentiated> all = {{{Quantity::young_modulus, 0}, 3e3}, {{Quantity::viscosity, 0}, 3e-2},
                                       {{Quantity::magnetization, 0}, 3e3}, {{Quantity::tail_magnetization, 0}, 1e3},
                                       {{Quantity::frequency, 0}, 1.6e-2},  {{Quantity::field, 0}, 1e-4},
                                       {{Quantity::field, 1}, 1e-4},        {{Quantity::initial_angle, 0}, 2e-2},
                                       {{Quantity::initial_shape, 0}, 5e-5}};
    if (!swimmer.keeps_area()) // others leave the shapes of this area
      all.push_back({{Quantity::initial_shape, 2}, 5e-5});
    IntegratorOptions options{.relative_tolerance = 1e-11};
    for (const auto &[parameter, step] : all)
      options.sensitivities.push_back(parameter);
    const Eigen::MatrixXd sensitivity = run_of(swimmer, request, options).sensitivity_at_period_end.back();

    options.sensitivities.clear();
    options.relative_tolerance = 1e-13; // differences magnify errors
    SwimmerIntegrator plain(swimmer, options);
    const auto        end = [&](const RunRequest &moved) { return plain.run(moved).at_period_end.back(); };
    for (std::size_t p = 0; p < all.size(); ++p)
    {
      const auto &[parameter, h] = all[p];
      const auto central         = [&](const double n) -> Eigen::VectorXd {
        return (end(shifted(request, parameter, n * h)) - end(shifted(request, parameter, -n * h))) / (2. * n * h);
      };
      // Their error falls with h^6.
      const Eigen::VectorXd difference = 1.5 * central(1.) - 0.6 * central(2.) + 0.1 * central(3.);
      const Eigen::VectorXd found      = sensitivity.col(static_cast<Eigen::Index>(p));
      EXPECT_LE((found - difference).norm(), 1e-6 * difference.norm()) << "parameter " << p;
      EXPECT_NEAR(found[0], difference[0], 1e-6 * difference.head<2>().norm()) << "parameter " << p;
    }
  }

  TEST_P(Runs, DisplacementsHaveTheirSensitivitiesToo)
  {
    const IntegratorOptions options{.relative_tolerance = 1e-10, .sensitivities = {{Quantity::magnetization, 0}}};
    constexpr double        heading = 0.2, step_A_m = 500.;
    const Eigen::MatrixXd   found = displacement_sensitivities(run_of(swimmer, request, options), heading);
    const auto              moved = [&](const double by) {
      return displacement_per_period(run_of(swimmer, shifted(request, {Quantity::magnetization, 0}, by), options),
                                                  heading);
    };
    const auto after = moved(step_A_m), before = moved(-step_A_m);
    ASSERT_EQ(found.rows(), 3);
    for (std::size_t i = 0; i < after.size(); ++i)
      EXPECT_NEAR(found(static_cast<Eigen::Index>(i), 0), (after[i] - before[i]) / (2. * step_A_m),
                  1e-3 * std::abs(found(static_cast<Eigen::Index>(i), 0)));
  }

  TEST_P(Runs, WorkBalances)
  {
    IntegratorOptions options{.relative_tolerance = 1e-8, .with_work = true};
    const SwimmerRun  run = run_of(swimmer, request, options);
    ASSERT_EQ(run.work.size(), 3u);
    for (const PeriodWork &work : run.work)
    {
      EXPECT_GT(work.magnetic, 0.);
      EXPECT_GT(work.dissipated, 0.);
      EXPECT_LE(std::abs(work.imbalance()), 1e3 * options.relative_tolerance); // some 300 steps
    }
  }

  TEST_P(Runs, TrajectoryHoldsTheMotion)
  {
    request.samples_per_period = 40;
    const SwimmerRun run       = run_of(swimmer, request);
    ASSERT_EQ(run.trajectory.size(), 121u);
    EXPECT_EQ(run.trajectory.front().time_s, 0.);
    EXPECT_NEAR(run.trajectory.front().tail_tip_x_m, 7.75e-3, 1e-15);
    EXPECT_NEAR(run.trajectory[40].time_s, 1.25, 1e-12);
    EXPECT_NEAR(run.trajectory[80].head_x_m, run.at_period_end[2][0], 1e-12);
    EXPECT_NEAR(run.trajectory.back().head_angle_rad, run.at_period_end.back()[2], 1e-9);
    RunSummary summary;
    summarize_motion(run.trajectory, 1.25, 0., summary);
    EXPECT_NEAR(summary.displacement_per_period_m[2], last_displacement(run), 1e-12);
  }

  TEST_P(Runs, ScalingStiffnessViscosityAndMagnetizationChangesNothing)
  {
    RunRequest scaled = request;
    scaled.parameters = {4. * request.parameters.young_modulus_Pa, 4. * request.parameters.viscosity_Pa_s,
                         4. * request.parameters.magnetization_A_m, 0.}; // by a power of two: to the last bit
    EXPECT_EQ(run_of(swimmer, scaled).at_period_end.back(), run_of(swimmer, request).at_period_end.back());
  }

  TEST_P(Runs, SampledFieldIsFollowedThroughItsKinks)
  {
    constexpr int                      n = 200;
    std::vector<double>                time_s;
    std::vector<std::array<double, 3>> b_T;
    const FieldProgram                 sine = FieldProgram::sinusoidal(5e-3, 5e-3, 0.8);
    for (int i = 0; i < n; ++i)
    {
      time_s.push_back(1.25 * i / n);
      b_T.push_back(sine(time_s.back()));
    }
    RunRequest sampled = request;
    sampled.drive      = make_drive(FieldProgram::sampled(time_s, b_T, 1.25));
    EXPECT_NEAR(sampled.drive.frequency_Hz, 0.8, 1e-15);
    const double smooth = last_displacement(run_of(swimmer, request));
    EXPECT_NEAR(last_displacement(run_of(swimmer, sampled)), smooth, 2e-3 * std::abs(smooth));
  }

  TEST_P(Runs, FailureIsAStatus)
  {
    IntegratorOptions options;
    options.max_steps    = 5;
    const SwimmerRun run = run_of(swimmer, request, options);
    EXPECT_EQ(run.status, RunStatus::failed);
    EXPECT_NE(run.failure.find("more than 5 steps"), std::string::npos) << run.failure;
    EXPECT_EQ(run.at_period_end.size(), 1u);
  }

  TEST_P(Runs, RefuseImpossibleValues)
  {
    RunRequest impossible                = request;
    impossible.parameters.viscosity_Pa_s = 0.;
    EXPECT_THROW(run_of(swimmer, impossible), InputError);
    impossible                    = request;
    impossible.drive.frequency_Hz = -1.;
    EXPECT_THROW(run_of(swimmer, impossible), InputError);
    EXPECT_THROW(run_of(swimmer, request, {.sensitivities = {{Quantity::field, 2}}}), InputError);
    EXPECT_THROW(run_of(swimmer, request, {.sensitivities = {{Quantity::initial_shape, 9}}}), InputError);
  }

  TEST(ClosedDomains, KeepTheArea)
  {
    const ReducedModel   model   = example_model({.keeps_area = true});
    const ReducedSwimmer swimmer = ReducedSwimmer(model);
    RunRequest           request = example_request(model);
    request.n_periods            = 20;
    const SwimmerRun  run        = run_of(swimmer, request);
    const ShapeVector q          = run.at_period_end.back().tail(model.n_modes());
    const double      per_period = 100. * IntegratorOptions().relative_tolerance * swimmer.length_m(); // some 100 steps
    EXPECT_LE(std::abs(swimmer.area_change(q)), request.n_periods * per_period * swimmer.area_gradient(q).norm());
  }

  INSTANTIATE_TEST_SUITE_P(OpenAndClosed, Runs, ::testing::Bool(),
                           [](const auto &instance) { return instance.param ? "closed" : "open"; });
} // namespace swimtwin
