#include <datasets/system/clocks.h>
#include <rom/integration/swimmer_integrator.h>
#include <rom/sensitivity/adjoint_check.h>
#include <rom/sensitivity/drift_gradient.h>
#include <rom/swimmer/bspline_field.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace swimtwin
{
  namespace
  {
    /// End and course of a motion, in numbers of order one: a bit of everything that can enter.
    class Course : public MotionFunctional
    {
    public:
      explicit Course(const double length_m) : L_(length_m) {}

      double terminal(const Eigen::Ref<const Eigen::VectorXd> &y) const override
      {
        return 3. * y[0] / L_ + y[1] * y[1] / (L_ * L_) + 0.1 * y[2] + y[3] / L_;
      }
      void add_terminal_gradient(const Eigen::Ref<const Eigen::VectorXd> &y,
                                 Eigen::Ref<Eigen::VectorXd>              by_state) const override
      {
        by_state[0] += 3. / L_;
        by_state[1] += 2. * y[1] / (L_ * L_);
        by_state[2] += 0.1;
        by_state[3] += 1. / L_;
      }
      double running(const MotionInstant &now) const override
      {
        const double miss = now.state[0] / L_ - 0.1 * now.phase;
        return miss * miss + 0.2 * now.state[2] * now.state[2] + 1e3 * now.field_T.squaredNorm() + now.state[4] / L_;
      }
      void add_running_gradient(const MotionInstant &now, InstantGradient &gradient) const override
      {
        gradient.by_state[0] += 2. * (now.state[0] / L_ - 0.1 * now.phase) / L_;
        gradient.by_state[2] += 0.4 * now.state[2];
        gradient.by_state[4] += 1. / L_;
        gradient.by_field += 2e3 * now.field_T;
      }

    private:
      double L_;
    };

    /// The end alone, which forward sensitivities know.
    class End : public Course
    {
    public:
      using Course::Course;
      double running(const MotionInstant &) const override { return 0.; }
      void   add_running_gradient(const MotionInstant &, InstantGradient &) const override {}
    };

    std::vector<Parameter> all_parameters(const RunRequest &request, const int n_modes)
    {
      std::vector<Parameter> parameters = {{Quantity::young_modulus, 0}, {Quantity::viscosity, 0},
                                           {Quantity::magnetization, 0}, {Quantity::tail_magnetization, 0},
                                           {Quantity::frequency, 0},     {Quantity::initial_angle, 0}};
      for (int k = 0; k < n_modes; ++k)
        parameters.push_back({Quantity::initial_shape, k});
      for (int i = 0; i < request.drive.parameters.size(); ++i)
        parameters.push_back({Quantity::field, i});
      return parameters;
    }

    /// The least of several, because others share the machine.
    template <typename Work>
    double shortest_s(const Work &work)
    {
      double shortest = 1e300;
      for (int i = 0; i < 7; ++i)
      {
        const double start = thread_cpu_time_s();
        work();
        shortest = std::min(shortest, thread_cpu_time_s() - start);
      }
      return shortest;
    }

    class Adjoint : public ::testing::Test
    {
    protected:
      const ReducedModel   model   = example_model({.n_followers = 2});
      const ReducedSwimmer swimmer = ReducedSwimmer(model);
      RunRequest           request = example_request(model);

      Adjoint()
      {
        request.n_periods        = 2;
        request.initial_state[2] = 0.2;
        request.initial_state[3] = 1e-4;
      }

      void use_splines(const int n_intervals)
      {
        const int periods = request.n_periods;
        request.drive     = spline_drive(request.drive, n_intervals, false, periods);
        request.n_periods = 1;
        max_step_periods  = 0.05 / periods;
      }
      double max_step_periods = 0.05;

      /// By forward sensitivities of the same motion.
      Eigen::VectorXd by_sensitivities(const MotionFunctional &functional, const std::vector<Parameter> &parameters,
                                       const double tolerance) const
      {
        SwimmerIntegrator integrator(
            swimmer,
            {.relative_tolerance = tolerance, .max_step_periods = max_step_periods, .sensitivities = parameters});
        const SwimmerRun run = integrator.run(request);
        Eigen::VectorXd  end = Eigen::VectorXd::Zero(swimmer.n_states());
        functional.add_terminal_gradient(run.at_period_end.back(), end);
        return run.sensitivity_at_period_end.back().transpose() * end;
      }

      /// Relative to the largest, per scale of each parameter.
      double difference_from_sensitivities(const double tolerance)
      {
        const End                    functional(swimmer.length_m());
        const std::vector<Parameter> parameters = all_parameters(request, swimmer.n_modes());
        const Eigen::VectorXd        exact      = by_sensitivities(functional, parameters, 1e-11);
        AdjointIntegrator    adjoint(swimmer, {.relative_tolerance = tolerance, .max_step_periods = max_step_periods});
        const MotionGradient gradient = adjoint.differentiate(request, functional);
        double               largest = 0., size = 0.;
        for (std::size_t i = 0; i < parameters.size(); ++i)
        {
          const auto   k     = static_cast<Eigen::Index>(i);
          const double scale = parameter_scale(request, parameters[i], swimmer.length_m());
          largest            = std::max(largest, scale * std::abs(gradient.by(parameters[i]) - exact[k]));
          size               = std::max(size, scale * std::abs(exact[k]));
        }
        return largest / size;
      }
    };
  } // namespace

  TEST_F(Adjoint, AgreesWithForwardSensitivitiesToTheTolerance)
  {
    use_splines(20);
    const double coarse = difference_from_sensitivities(1e-6), fine = difference_from_sensitivities(1e-8);
    std::printf("adjoint against forward sensitivities: %.1e at 1e-6, %.1e at 1e-8\n", coarse, fine);
    EXPECT_LE(coarse, 1e-4);
    EXPECT_LE(fine, 1e-6);
  }

  TEST_F(Adjoint, AgreesWithDifferencesForEndAndCourse)
  {
    use_splines(8);
    AdjointIntegrator adjoint(swimmer, {.relative_tolerance = 1e-11, .max_step_periods = max_step_periods});
    const auto        checks =
        check_adjoint(adjoint, request, Course(swimmer.length_m()), all_parameters(request, swimmer.n_modes()));
    for (const AdjointCheck &check : checks)
      EXPECT_NEAR(check.scale * check.by_adjoint, check.scale * check.by_differences,
                  1e-5 * std::max(1e-2, std::abs(check.scale * check.by_differences)));
    EXPECT_LE(largest_error(checks), 1e-5);
  }

  TEST_F(Adjoint, AgreesWithDifferencesAcrossTheKinksOfAPiecewiseLinearField)
  {
    request.drive.field = std::make_shared<PiecewiseLinearField>(std::vector<double>{0., 0.2, 0.45, 0.8});
    request.drive.parameters.resize(8);
    request.drive.parameters << 5e-3, 0., 4e-3, 5e-3, 5e-3, -4e-3, 6e-3, 1e-3;
    AdjointIntegrator adjoint(swimmer, {.relative_tolerance = 1e-11});
    // The tail is large: with steps of a hundredth of the head's magnetization the differences themselves are off by
    // 1.8e-5, falling with the fourth power of the step.
    constexpr double step = 2.5e-3;
    EXPECT_LE(largest_error(check_adjoint(adjoint, request, Course(swimmer.length_m()),
                                          all_parameters(request, swimmer.n_modes()), step)),
              1e-5);
  }

  TEST_F(Adjoint, ValueIsTheSameWithAndWithoutDerivatives)
  {
    const Course      functional(swimmer.length_m());
    AdjointIntegrator adjoint(swimmer);
    const double      value = adjoint.evaluate(request, functional).value;
    EXPECT_NEAR(adjoint.differentiate(request, functional).value, value, 1e-7 * std::abs(value));
  }

  TEST_F(Adjoint, ShiftingTheStartShiftsTheEnd)
  {
    AdjointIntegrator    adjoint(swimmer);
    const End            functional(swimmer.length_m());
    const MotionGradient gradient = adjoint.differentiate(request, functional);
    EXPECT_NEAR(gradient.by_initial_state[0], 3. / swimmer.length_m(), 1e-9);
  }

  TEST_F(Adjoint, CostsAtMostSixRunsForTenAndForTwoHundredParameters)
  {
    request.n_periods = 5;
    use_splines(97);
    const End        functional(swimmer.length_m());
    const RunRequest many = request;
    for (const int n_intervals : {2, 97})
    {
      RunRequest few          = example_request(model);
      few.n_periods           = 5;
      few.drive               = spline_drive(few.drive, 5, true);
      const RunRequest &asked = n_intervals == 2 ? few : many;
      const double      step  = n_intervals == 2 ? 0.05 : max_step_periods;
      SwimmerIntegrator plain(swimmer, {.max_step_periods = step});
      AdjointIntegrator adjoint(swimmer, {.max_step_periods = step});
      const double      run_s     = shortest_s([&] { plain.run(asked); });
      const double      adjoint_s = shortest_s([&] { adjoint.differentiate(asked, functional); });
      std::printf("%d field parameters: adjoint with its forward run takes %.2f plain runs of %.2f ms\n",
                  static_cast<int>(asked.drive.parameters.size()), adjoint_s / run_s, 1e3 * run_s);
      EXPECT_LE(adjoint_s, 6. * run_s);
    }
  }

  TEST_F(Adjoint, DriftOfAPeriodicMotionHasTheSensitivitiesOfTheOrbit)
  {
    for (const ExampleOptions &options :
         {ExampleOptions{.magnetic_tail = false}, ExampleOptions{.keeps_area = true, .magnetic_tail = false},
          ExampleOptions{.magnetic_tail = false, .has_inertia = true}})
    {
      const ReducedModel   closed = example_model(options);
      const ReducedSwimmer other(closed, example_densities(options));
      RunRequest           periodic     = example_request(closed);
      periodic.initial_state            = state_at_rest(other);
      periodic.drive                    = spline_drive(periodic.drive, 24, true);
      std::vector<Parameter> parameters = {{Quantity::young_modulus, 0},
                                           {Quantity::viscosity, 0},
                                           {Quantity::magnetization, 0},
                                           {Quantity::frequency, 0}};
      for (int i = 0; i < periodic.drive.parameters.size(); ++i)
        parameters.push_back({Quantity::field, i});
      PeriodicOrbitFinder finder(other, {.relative_tolerance = 1e-9, .closure = 1e-9, .parameters = parameters});
      const PeriodicOrbit orbit = finder.find(periodic);
      ASSERT_TRUE(orbit.converged()) << orbit.failure;
      const Eigen::Vector2d direction(0.8, -0.6);
      const MotionGradient  gradient =
          differentiate_drift(other, periodic, orbit, direction, {.relative_tolerance = 1e-9});
      const Eigen::RowVectorXd exact = direction.transpose() * orbit.drift_sensitivity;
      for (std::size_t i = 0; i < parameters.size(); ++i)
      {
        const auto   k     = static_cast<Eigen::Index>(i);
        const double scale = parameters[i].quantity == Quantity::field ? exact.tail(48).norm() : std::abs(exact[k]);
        EXPECT_NEAR(gradient.by(parameters[i]), exact[k], 1e-5 * scale) << i;
      }
    }
  }
} // namespace swimtwin
