#include <tests/pipeline/simulation.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    class PowerBalance : public testing::TestWithParam<const char *>
    {
    };
  } // namespace

  TEST_P(PowerBalance, ClosesToHalfAPercentWithTheSettingsAsShipped)
  {
    const Motion motion = simulate({GetParam(), {"time.periods=1", "time.steps_per_period=100"}});
    EXPECT_LE(std::abs(motion.summary.power_imbalance), 0.005);
    EXPECT_NE(motion.summary.power_imbalance, 0.);
  }

  INSTANTIATE_TEST_SUITE_P(ReferenceScenes, PowerBalance,
                           testing::Values("reference-2d-paper", "reference-2d-casefile"),
                           [](const auto &test) { return test.index == 0 ? "Paper" : "Casefile"; });

  // The first period, where nothing is periodic: there the trapezoidal rule has no better order than BDF2. A halved
  // step divides the imbalance by 4 in the limit; 3 allows for the next order at 12 steps per half swing. The
  // tolerances (1e-9) are far below the smallest imbalance here (1e-4).
  TEST(PowerBalanceOfTheFirstPeriod, FallsAtSecondOrderInTheStep)
  {
    double before = 0.;
    for (const int n : {25, 50, 100})
    {
      const auto motion =
          simulate(coarse_swimmer(n, 1.).with({"numerics.coupling_tolerance=1e-9", "numerics.linear_tolerance=1e-9"}));
      const double imbalance = std::abs(motion.summary.power_imbalance);
      RecordProperty("imbalance_at_" + std::to_string(n), std::to_string(imbalance));
      if (before > 0.)
      {
        EXPECT_GE(before / imbalance, 3.) << n << " steps per period";
      }
      before = imbalance;
    }
  }
} // namespace swimtwin
