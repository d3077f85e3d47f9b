#include <fom/algebra/bdf2.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Error at t = 1 of y' = -y with steps h, h, 2h, h, h, 2h, ...: ratios 1, 2, 1/2. The second value is exact.
    double error_with_uneven_steps(const int n_patterns)
    {
      const double h = 1. / (4. * n_patterns);
      double       t = h, dt_before = h, before = 1., now = std::exp(-h);
      for (int k = 1; k < 3 * n_patterns; ++k)
      {
        const double dt = k % 3 == 2 ? 2. * h : h;
        const Bdf2   bdf(dt, dt_before);
        const double next = bdf.known(now, before) / (1. + bdf.slope_weight);
        before            = now;
        now               = next;
        dt_before         = dt;
        t += dt;
      }
      EXPECT_NEAR(t, 1., 1e-12);
      return std::abs(now - std::exp(-1.));
    }
  } // namespace

  // The measured order approaches two from either side with the next term of the error, of relative size h.
  TEST(Bdf2, IsOfSecondOrderWithUnevenSteps)
  {
    for (const int n : {20, 40, 80})
    {
      const double order = std::log2(error_with_uneven_steps(n) / error_with_uneven_steps(2 * n));
      EXPECT_NEAR(order, 2., 2. / n);
    }
  }

  TEST(Bdf2, IsExactForQuadratics)
  {
    const auto y     = [](const double t) { return 3. - 2. * t + 5. * t * t; };
    const auto slope = [](const double t) { return -2. + 10. * t; };
    for (const double ratio : {0.5, 1., 2., 0.3})
    {
      const double t = 0.7, dt_before = 0.2, dt = ratio * dt_before;
      const Bdf2   bdf(dt, dt_before);
      EXPECT_NEAR(bdf.known(y(t), y(t - dt_before)) + bdf.slope_weight * slope(t + dt), y(t + dt), 1e-14);
    }
  }

  TEST(Bdf2, EqualStepsGiveTheClassicalWeights)
  {
    const Bdf2 bdf(0.3, 0.3);
    EXPECT_NEAR(bdf.before_weight, -1. / 3., 1e-15);
    EXPECT_NEAR(bdf.slope_weight, 0.2, 1e-15);
  }

  TEST(Bdf2, StartsAsBackwardEuler)
  {
    const Bdf2 bdf(0.3, 0.);
    EXPECT_EQ(bdf.before_weight, 0.);
    EXPECT_EQ(bdf.slope_weight, 0.3);
  }
} // namespace swimtwin
