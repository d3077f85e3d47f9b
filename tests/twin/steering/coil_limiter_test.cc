#include <twin/steering/coil_limiter.h>

#include <gtest/gtest.h>

#include <random>

namespace swimtwin
{
  namespace
  {
    FieldLimits some_limits()
    {
      FieldLimits limits;
      limits.magnitude_T           = 6e-3;
      limits.component_T           = {5e-3, 4e-3};
      limits.slew_rate_T_s         = 0.1;
      limits.current_per_field_A_T = Eigen::Matrix<double, 2, 2>{{700., 100.}, {-200., 900.}};
      limits.current_A             = 3.;
      return limits;
    }

    TEST(CoilLimiter, KeepsEveryLimitWhateverIsWanted)
    {
      const FieldLimits                limits = some_limits();
      const CoilLimiter                limiter(limits);
      std::mt19937                     random(1);
      std::normal_distribution<double> normal(0., 8e-3);
      Eigen::Vector2d                  now(0., 0.);
      constexpr double                 step_s = 7e-3, round = 1. + 1e-12;
      for (int i = 0; i < 5000; ++i)
      {
        const Eigen::Vector2d next = limiter.moved(now, {normal(random), normal(random)}, step_s);
        EXPECT_LE(next.norm(), limits.magnitude_T * round);
        EXPECT_LE(std::abs(next.x()), limits.component_T[0] * round);
        EXPECT_LE(std::abs(next.y()), limits.component_T[1] * round);
        EXPECT_LE((limits.current_per_field_A_T * next).cwiseAbs().maxCoeff(), limits.current_A * round);
        EXPECT_LE((next - now).norm(), limits.slew_rate_T_s * step_s * round);
        now = next;
      }
    }

    TEST(CoilLimiter, LeavesAloneWhatCanBePlayed)
    {
      const CoilLimiter     limiter(some_limits());
      const Eigen::Vector2d weak(1e-3, -2e-3);
      EXPECT_EQ(limiter.limited(weak), weak);
      EXPECT_EQ(limiter.moved({9e-4, -2e-3}, weak, 1e-2), weak);
      EXPECT_EQ(CoilLimiter(FieldLimits()).moved({0., 0.}, {1., 2.}, 1e-3), Eigen::Vector2d(1., 2.));
    }
  } // namespace
} // namespace swimtwin
