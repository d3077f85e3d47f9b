#include <datasets/scene/inertia_terms.h>
#include <rom/integration/swimmer_integrator.h>
#include <rom/swimmer/carried_inertia.h>
#include <tests/control/small_model.h>
#include <tests/rom/example_model.h>
#include <tests/twin/open_swimmer.h>
#include <twin/motion/state_transition.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    struct Steps
    {
      bool            completed = true;
      SwimmerState    state;
      Eigen::MatrixXd by_start, by_parameters; ///< of the end by the first start and by parameters
    };

    Steps go(const ReducedSwimmer &swimmer, const RunRequest &request, const int n_steps, const double periods = 1.,
             const Eigen::Vector2d &background_T = Eigen::Vector2d::Zero())
    {
      FieldSignal field;
      field.play(0., request.drive);
      StateTransition transition(swimmer);
      const auto      n = swimmer.n_states();
      Steps           steps{true, request.initial_state, Eigen::MatrixXd::Identity(n, n),
                  Eigen::MatrixXd::Zero(n, n_step_parameters)};
      const double    h = periods / request.drive.frequency_Hz / n_steps;
      for (int i = 0; i < n_steps && steps.completed; ++i)
      {
        steps.completed = transition.advance(field, i * h, (i + 1) * h, request.parameters, background_T, steps.state);
        steps.by_start  = transition.by_start() * steps.by_start;
        steps.by_parameters = transition.by_start() * steps.by_parameters + transition.by_parameters();
      }
      return steps;
    }

    RunRequest bent_request(const ReducedModel &model)
    {
      RunRequest request       = small_request(model);
      request.initial_state    = SwimmerState::Zero(model.n_modes() + 3);
      request.initial_state[2] = 0.2;
      request.initial_state[3] = 1e-4;
      return request;
    }

    TEST(StateTransition, LeadsWhereTheIntegratorLeads)
    {
      const ReducedModel   model = open_model();
      const ReducedSwimmer swimmer(model);
      RunRequest           request = bent_request(model);
      request.n_periods            = 1;
      SwimmerIntegrator  integrator(swimmer, {.relative_tolerance = 1e-10});
      const SwimmerState exact  = integrator.run(request).at_period_end.back();
      const Steps        coarse = go(swimmer, request, 40), fine = go(swimmer, request, 160);
      ASSERT_TRUE(coarse.completed && fine.completed);
      const double stroke = 0.03 * swimmer.length_m();
      EXPECT_LT((fine.state - exact).head<2>().norm() / stroke, 1e-5);
      EXPECT_LT((fine.state - exact).tail(model.n_modes()).norm() / stroke, 1e-5);
      EXPECT_LT(std::abs(fine.state[2] - exact[2]), 1e-5);
      // Forty steps per period are far better than what a camera sees.
      EXPECT_LT((coarse.state - exact).head<2>().norm() / stroke, 2e-3);
      EXPECT_LT(std::abs(coarse.state[2] - exact[2]), 2e-3);
    }

    TEST(StateTransition, FeelsTheHeightBetweenWalls)
    {
      const ReducedModel   model = example_model({.depends_on_height = true});
      const ReducedSwimmer swimmer(model);
      RunRequest           request = example_request(model);
      request.initial_state[1]     = 4e-4;
      request.n_periods            = 1;
      const SwimmerState exact =
          SwimmerIntegrator(swimmer, {.relative_tolerance = 1e-10}).run(request).at_period_end.back();
      const Steps fine = go(swimmer, request, 320);
      ASSERT_TRUE(fine.completed);
      EXPECT_LT((fine.state - exact).head<2>().norm() / (0.03 * swimmer.length_m()), 1e-4);
      EXPECT_LT(std::abs(fine.state[2] - exact[2]), 1e-4);
    }

    InertialDensities all_densities(const ReducedModel &model)
    {
      return inertial_densities(model, all_inertia);
    }

    TEST(StateTransition, LeadsASwimmerWithInertiaWhereTheIntegratorLeads)
    {
      const ReducedModel   model = read_reduced_model(std::string(places::models) + "/reference-2d.h5");
      const ReducedSwimmer swimmer(model, all_densities(model));
      RunRequest           request = example_request(model);
      request.initial_state        = state_at_rest(swimmer);
      request.n_periods            = 1;
      const SwimmerState exact =
          SwimmerIntegrator(swimmer, {.relative_tolerance = 1e-10}).run(request).at_period_end.back();
      const Steps fine = go(swimmer, request, 320);
      ASSERT_TRUE(fine.completed);
      const double stroke = 0.03 * swimmer.length_m();
      EXPECT_LT((fine.state - exact).head<2>().norm() / stroke, 1e-4);
      EXPECT_LT(std::abs(fine.state[2] - exact[2]), 1e-4);
      // Velocities follow the forces: they are right as soon as pose and shape are.
      EXPECT_LT((fine.state - exact).tail(swimmer.n_velocities()).head<2>().norm() * request.n_periods /
                    request.drive.frequency_Hz / stroke,
                1e-3);
    }

    TEST(StateTransition, HasTheDerivativesOfItsOwnStep)
    {
      struct Kind
      {
        bool keeps_area = false, depends_on_height = false, has_inertia = false;
      };
      for (const auto &[keeps_area, depends_on_height, has_inertia] :
           {Kind{}, Kind{.keeps_area = true}, Kind{.depends_on_height = true}, Kind{.has_inertia = true},
            Kind{.depends_on_height = true, .has_inertia = true}})
      {
        const ReducedModel   model = example_model({.n_modes           = 4,
                                                    .n_followers       = keeps_area ? 0 : 2,
                                                    .keeps_area        = keeps_area,
                                                    .depends_on_height = depends_on_height,
                                                    .has_inertia       = has_inertia});
        const ReducedSwimmer swimmer(model, has_inertia ? all_densities(model) : InertialDensities());
        RunRequest           request = example_request(model);
        request.initial_state        = state_at_rest(swimmer);
        request.initial_state[2]     = 0.3;
        const Eigen::Vector2d background(2e-4, -3e-4);
        const Steps           steps = go(swimmer, request, 5, 0.15, background);
        ASSERT_TRUE(steps.completed);
        const auto differ = [&](const auto &change, const double size) {
          RunRequest      plus = request, minus = request;
          Eigen::Vector2d b_plus = background, b_minus = background;
          change(plus, b_plus, size);
          change(minus, b_minus, -size);
          return Eigen::VectorXd(
              (go(swimmer, plus, 5, 0.15, b_plus).state - go(swimmer, minus, 5, 0.15, b_minus).state) / (2. * size));
        };
        const auto expect_column = [](const Eigen::VectorXd &exact, const Eigen::VectorXd &differences) {
          EXPECT_LT((exact - differences).norm(), 1e-5 * differences.norm());
        };
        for (int i = 0; i < swimmer.n_states() && !keeps_area; ++i)
          expect_column(steps.by_start.col(i),
                        differ([i](RunRequest &r, Eigen::Vector2d &, const double d) { r.initial_state[i] += d; },
                               i == 2 ? 1e-4 : 1e-7));
        expect_column(steps.by_parameters.col(log_stiffness),
                      differ([](RunRequest  &r, Eigen::Vector2d &,
                                const double d) { r.parameters.young_modulus_Pa *= std::exp(d); },
                             1e-4));
        expect_column(steps.by_parameters.col(log_magnetization),
                      differ(
                          [](RunRequest &r, Eigen::Vector2d &, const double d) {
                            r.parameters.magnetization_A_m *= std::exp(d);
                            r.parameters.tail_magnetization_A_m *= std::exp(d);
                          },
                          1e-4));
        for (int i = 0; i < 2; ++i)
          expect_column(steps.by_parameters.col(background_x + i),
                        differ([i](RunRequest &, Eigen::Vector2d &b, const double d) { b[i] += d; }, 1e-7));
      }
    }

    TEST(StateTransition, LeavesTheStateWhereNewtonsMethodFindsNoWay)
    {
      const ReducedModel   model = open_model();
      const ReducedSwimmer swimmer(model);
      RunRequest           request = bent_request(model);
      FieldSignal          field;
      field.play(0., request.drive);
      StateTransition transition(swimmer);
      SwimmerState    state = request.initial_state;
      EXPECT_FALSE(transition.advance(field, 0., 1., request.parameters, {NAN, 0.}, state));
      EXPECT_EQ(state, request.initial_state);
    }
  } // namespace
} // namespace swimtwin
