#include <rom/bspline_field.h>
#include <rom/motion_linearisation.h>
#include <rom/swimmer_integrator.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    class Linearisation : public ::testing::Test
    {
    protected:
      const ReducedModel   model   = example_model();
      const ReducedSwimmer swimmer = ReducedSwimmer(model);
      RunRequest           request = example_request(model);

      Linearisation()
      {
        request.n_periods        = 1;
        request.drive            = spline_drive(request.drive, 8, true);
        request.initial_state[2] = 0.1;
      }

      std::vector<LinearisedInstant> linearise(const RunRequest &asked) const
      {
        MotionStore    store(swimmer, {.relative_tolerance = 1e-10});
        PhaseEquations equations(swimmer, {});
        equations.start(asked);
        std::vector<double> phases;
        for (int i = 1; i <= 40; ++i)
          phases.push_back(i / 40.);
        return linearise_motion(equations, store.run(asked), phases);
      }
    };
  } // namespace

  TEST_F(Linearisation, IsThatOfForwardSensitivities)
  {
    std::vector<Parameter> parameters;
    for (int i = 0; i < request.drive.parameters.size(); ++i)
      parameters.push_back({Quantity::field, i});
    SwimmerIntegrator     integrator(swimmer, {.relative_tolerance = 1e-10, .sensitivities = parameters});
    const Eigen::MatrixXd exact = integrator.run(request).sensitivity_at_period_end.back();
    const Eigen::MatrixXd ours  = linearise(request).back().by_parameters;
    for (Eigen::Index i = 0; i < exact.rows(); ++i)
      EXPECT_LE((ours.row(i) - exact.row(i)).norm(), 2e-5 * exact.row(i).norm()) << i;
  }

  TEST_F(Linearisation, IsTheDerivativeOfStateAndIntegral)
  {
    constexpr double h   = 1e-6; // T
    const auto       now = linearise(request);
    for (const Eigen::Index p : {0, 7, 12})
    {
      RunRequest up = request, down = request;
      up.drive.parameters[p] += h;
      down.drive.parameters[p] -= h;
      const auto above = linearise(up), below = linearise(down);
      for (const std::size_t i : {20u, 40u})
      {
        const Eigen::VectorXd state    = (above[i].state - below[i].state) / (2. * h);
        const Eigen::VectorXd integral = (above[i].integral - below[i].integral) / (2. * h);
        EXPECT_LE((now[i].by_parameters.col(p) - state).norm(), 1e-5 * state.norm());
        EXPECT_LE((now[i].integral_by_parameters.col(p) - integral).norm(), 1e-5 * integral.norm());
      }
    }
  }
} // namespace swimtwin
