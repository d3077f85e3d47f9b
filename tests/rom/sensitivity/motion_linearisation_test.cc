#include <rom/integration/swimmer_integrator.h>
#include <rom/sensitivity/motion_linearisation.h>
#include <rom/swimmer/bspline_field.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

#include <algorithm>

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

      std::vector<LinearisedInstant> linearise(const RunRequest &asked, const int n_instants = 160) const
      {
        MotionStore    store(swimmer, {.relative_tolerance = 1e-11});
        PhaseEquations equations(swimmer, {});
        equations.start(asked);
        std::vector<double> phases;
        for (int i = 1; i <= n_instants; ++i)
          phases.push_back(static_cast<double>(i) / n_instants);
        return linearise_motion(equations, store.run(asked), phases);
      }
    };
  } // namespace

  TEST_F(Linearisation, IsThatOfForwardSensitivities)
  {
    std::vector<Parameter> parameters;
    for (int i = 0; i < request.drive.parameters.size(); ++i)
      parameters.push_back({Quantity::field, i});
    SwimmerIntegrator     integrator(swimmer, {.relative_tolerance = 1e-11, .sensitivities = parameters});
    const Eigen::MatrixXd exact = integrator.run(request).sensitivity_at_period_end.back();
    const auto            error = [&](const int n_instants) {
      const Eigen::MatrixXd ours    = linearise(request, n_instants).back().by_parameters;
      double                largest = 0.;
      for (Eigen::Index i = 0; i < exact.rows(); ++i)
        largest = std::max(largest, (ours.row(i) - exact.row(i)).norm() / exact.row(i).norm());
      return largest;
    };
    EXPECT_LE(error(160), 1e-5);
    EXPECT_LE(error(20), 1e-4);
  }

  TEST_F(Linearisation, IsTheDerivativeOfStateAndIntegral)
  {
    constexpr double h   = 5e-5; // T: with the motion's error, 1e-11, over it
    const auto       now = linearise(request);
    for (const Eigen::Index p : {0, 7, 12})
    {
      const auto at = [&](const double change) {
        RunRequest other = request;
        other.drive.parameters[p] += change;
        return linearise(other);
      };
      const auto up = at(h), down = at(-h), far_up = at(2. * h), far_down = at(-2. * h);
      for (const std::size_t i : {80u, 160u})
      {
        const auto slope = [&](const auto &value) {
          return Eigen::VectorXd((8. * (value(up[i]) - value(down[i])) - (value(far_up[i]) - value(far_down[i]))) /
                                 (12. * h));
        };
        const Eigen::VectorXd state    = slope([](const LinearisedInstant &l) { return l.state; });
        const Eigen::VectorXd integral = slope([](const LinearisedInstant &l) { return l.integral; });
        EXPECT_LE((now[i].by_parameters.col(p) - state).norm(), 1e-5 * state.norm());
        EXPECT_LE((now[i].integral_by_parameters.col(p) - integral).norm(), 1e-5 * integral.norm());
      }
    }
  }
} // namespace swimtwin
