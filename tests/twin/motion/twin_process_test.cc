#include <rom/integration/swimmer_integrator.h>
#include <tests/twin/open_swimmer.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    struct Advanced
    {
      Eigen::VectorXd mean;
      Eigen::MatrixXd transition, noise;
    };

    Advanced advance(TwinProcess &process, const Eigen::VectorXd &start, const double to_s)
    {
      const auto n = process.n_states();
      Advanced   a{start, Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, process.n_noises())};
      EXPECT_TRUE(process.advance(0.1, to_s, a.mean, a.transition, a.noise));
      return a;
    }

    TEST(TwinProcess, KnowsHowItsStepDependsOnEverything)
    {
      OpenSwimmer           open;
      const Eigen::VectorXd start = open.some_state(), change = open.small_change();
      const Advanced        a = advance(open.process, start, 0.13);
      for (Eigen::Index i = 0; i < start.size(); ++i)
      {
        Eigen::VectorXd plus = start, minus = start;
        plus[i] += change[i];
        minus[i] -= change[i];
        const Eigen::VectorXd slope =
            (advance(open.process, plus, 0.13).mean - advance(open.process, minus, 0.13).mean) / (2. * change[i]);
        EXPECT_LT((a.transition.col(i) - slope).norm(), 1e-5 * slope.norm()) << "entry " << i;
      }
    }

    /// Where the swimmer is after a period of its field from a bent start.
    Eigen::VectorXd after_a_period(OpenSwimmer &open, Eigen::VectorXd state)
    {
      constexpr int   n_steps = 160;
      const double    step_s  = 1. / 0.8 / n_steps;
      Eigen::MatrixXd transition(state.size(), state.size()), noise(state.size(), open.process.n_noises());
      for (int i = 0; i < n_steps; ++i)
        EXPECT_TRUE(open.process.advance(i * step_s, (i + 1) * step_s, state, transition, noise));
      return state.head(open.swimmer.n_states());
    }

    // An independent integrator that is told moduli, not logarithms.
    TEST(TwinProcess, MovesAsASwimmerWithTheModuliThatItsLogarithmsStandFor)
    {
      TwinParameters parameters;
      parameters[TwinParameter::stiffness] = parameters[TwinParameter::magnetization] = {0., 0.1, 0.};
      OpenSwimmer     open(parameters);
      Eigen::VectorXd start = open.some_state(), nominal = start;
      nominal[open.layout.place(TwinParameter::stiffness)] = nominal[open.layout.place(TwinParameter::magnetization)] =
          0.;

      RunRequest request;
      request.parameters = open_parameters(open.model);
      request.parameters.young_modulus_Pa *= std::exp(start[open.layout.place(TwinParameter::stiffness)]);
      request.parameters.magnetization_A_m *= std::exp(start[open.layout.place(TwinParameter::magnetization)]);
      request.drive         = make_drive(FieldProgram::sinusoidal(4e-3, 4e-3, 0.8));
      request.initial_state = start.head(open.swimmer.n_states());
      request.n_periods     = 1;
      SwimmerIntegrator integrator(open.swimmer, {.relative_tolerance = 1e-10});
      // After a period the shape has forgotten the start, whose first instants no step resolves.
      request.initial_state               = integrator.run(request).at_period_end.back();
      start.head(open.swimmer.n_states()) = nominal.head(open.swimmer.n_states()) = request.initial_state;

      const Eigen::VectorXd exact = integrator.run(request).at_period_end.back();
      const double          off   = (after_a_period(open, start) - exact).head<2>().norm();
      EXPECT_LT(off, 1e-5 * open.swimmer.length_m());
      EXPECT_GT((after_a_period(open, nominal) - exact).head<2>().norm(), 20. * off); // there is something to be seen
    }

    TEST(TwinProcess, CarriesTheSwimmerWithTheFluid)
    {
      OpenSwimmer     open;
      Eigen::VectorXd start = open.some_state(), still = start;
      still[open.layout.place(TwinParameter::flow_x)] = still[open.layout.place(TwinParameter::flow_y)] = 0.;
      const Eigen::VectorXd way = advance(open.process, start, 0.13).mean - advance(open.process, still, 0.13).mean;
      EXPECT_NEAR(way[0], 0.03 * 2e-5, 1e-12);
      EXPECT_NEAR(way[1], -0.03 * 1e-5, 1e-12);
    }

    TEST(TwinProcess, LetsAWarmingFluidMoveStiffnessAndMagnetizationTogether)
    {
      TwinParameters parameters;
      parameters[TwinParameter::stiffness]     = {0., 0.1, 0.};
      parameters[TwinParameter::magnetization] = {0., 0.1, 0.};
      parameters.viscosity_drift               = 0.01;
      OpenSwimmer           open(parameters);
      const Advanced        a    = advance(open.process, open.some_state(), 0.13);
      const auto            rows = a.noise.bottomRows(2);
      const Eigen::Matrix2d Q    = rows * rows.transpose();
      EXPECT_NEAR(Q(0, 0), 1e-4 * 0.03, 1e-12);
      EXPECT_NEAR(Q(0, 1), Q(0, 0), 1e-15);
      EXPECT_NEAR(Q(1, 1), Q(0, 0), 1e-15);
    }
  } // namespace
} // namespace swimtwin
