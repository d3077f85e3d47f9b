#include <tests/twin/open_swimmer.h>
#include <twin/estimate/model_bias.h>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    struct ModelBias : ::testing::Test
    {
      ReducedModel      model = open_model();
      ReducedSwimmer    swimmer{model};
      SwimmerParameters parameters = open_parameters(model);
      Drive             drive      = make_drive(FieldProgram::sinusoidal(4e-3, 4e-3, 0.8));

      Eigen::Matrix2d bias(const double error, const Eigen::Vector2d &sd = {10., 10.}) const
      {
        return ratio_bias(swimmer, parameters, drive, error, sd);
      }
    };
  } // namespace

  TEST_F(ModelBias, IsTheChangeThatLooksLikeTheError)
  {
    constexpr double      error  = 2e-3;
    const Eigen::Matrix2d root   = bias(error).llt().matrixL();
    const PeriodicMotion  motion = periodic_motion(swimmer, parameters, drive);
    for (int i = 0; i < 2; ++i)
    {
      SwimmerParameters shifted = parameters;
      shifted.young_modulus_Pa *= std::exp(root(0, i));
      shifted.magnetization_A_m *= std::exp(root(1, i));
      const PeriodicMotion seen = periodic_motion(swimmer, shifted, drive);
      EXPECT_NEAR(std::hypot(std::log(seen.displacement_m / motion.displacement_m),
                             std::log(seen.swing_rad / motion.swing_rad)),
                  error, 0.03 * error);
    }
  }

  TEST_F(ModelBias, GrowsWithTheErrorUpToWhatWasKnownBefore)
  {
    EXPECT_EQ(bias(0.), Eigen::Matrix2d::Zero());
    EXPECT_TRUE(bias(2e-3).isApprox(4. * bias(1e-3), 1e-4));
    const Eigen::Vector2d known(0.1, 0.05);
    EXPECT_TRUE(bias(1e6, known).isApprox(Eigen::Matrix2d(known.cwiseAbs2().asDiagonal()), 1e-6));
    const Eigen::Matrix2d fixed = bias(2e-3, {0., 0.1});
    EXPECT_EQ(fixed.row(0).norm() + fixed.col(0).norm(), 0.);
    EXPECT_GT(fixed(1, 1), 0.);
    EXPECT_LT(fixed(1, 1), bias(2e-3)(1, 1)); // one unknown fewer
  }

  /// Only E/mu and M/mu count: the same swimmer in a fluid of twice the viscosity, all else scaled with it.
  TEST_F(ModelBias, IsThatOfTheRatios)
  {
    const Eigen::Matrix2d before = bias(2e-3);
    parameters.viscosity_Pa_s *= 2.;
    parameters.young_modulus_Pa *= 2.;
    parameters.magnetization_A_m *= 2.;
    EXPECT_TRUE(bias(2e-3).isApprox(before, 1e-3));
  }
} // namespace swimtwin
