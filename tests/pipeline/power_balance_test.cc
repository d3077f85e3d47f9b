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
} // namespace swimtwin
