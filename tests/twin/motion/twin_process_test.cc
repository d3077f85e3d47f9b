#include <tests/twin/open_swimmer.h>

#include <gtest/gtest.h>

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
