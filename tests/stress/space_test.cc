#include <tests/stress/hard_swimmers.h>

#include <tests/places.h>

#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    constexpr int few_steps = 10;

    ShrunkScene hard_swimmer_in_space(const std::vector<std::string> &settings)
    {
      return coarse_swimmer_in_space(1.)
          .with({"time.steps_per_period=" + std::to_string(few_steps), "output.snapshots_per_period=0"})
          .with(settings);
    }

    /// Complete and balanced, or open and said so, or one sentence that names the time and what to change.
    void expect_an_honest_end(const ShrunkScene &scene)
    {
      const TemporaryFolder folder;
      const Outcome         outcome = run_tool(simulate_arguments(scene, folder.path / "run", {"--quiet"}));
      const RunSummary      summary = read_run_summary_json(folder.path / "run/summary.json").summary;
      std::cout << summary.status << ", worst imbalance " << summary.worst_power_imbalance.value_or(NAN) << ", "
                << summary.n_remeshes << " remeshings, " << summary.n_step_halvings << " halved steps" << std::endl;
      if (outcome.exit_code == 0)
      {
        const Motion motion = read_motion(folder.path / "run");
        EXPECT_EQ(summary.status, "completed");
        EXPECT_EQ(motion.trajectory.size(), few_steps + 1u);
        if (std::abs(summary.worst_power_imbalance.value()) > balance_bound(few_steps))
          expect_in(outcome.err, "the power balance is open");
        else
          EXPECT_EQ(outcome.err, "");
        return;
      }
      EXPECT_EQ(outcome.exit_code, 1);
      expect_in(outcome.err, "t = ");
      EXPECT_EQ(summary.status.substr(0, 7), "failed:");
      EXPECT_FALSE(std::filesystem::exists(folder.path / "run/trajectory.csv"));
    }
  } // namespace

  TEST(HardSwimmersInSpace, ASoftTailEndsHonestlyInFewSteps)
  {
    expect_an_honest_end(hard_swimmer_in_space({"tail.young_modulus_Pa=1e3", "tail.law=neo-hookean"}));
  }

  TEST(HardSwimmersInSpace, AThinFluidWithInertiaEndsHonestlyInFewSteps)
  {
    expect_an_honest_end(hard_swimmer_in_space({"fluid.viscosity_Pa_s=1e-2", "fluid.inertia=full"}));
  }

  TEST(HardSwimmersInSpace, AThickFluidEndsHonestlyInFewSteps)
  {
    expect_an_honest_end(hard_swimmer_in_space({"fluid.viscosity_Pa_s=1e3"}));
  }
} // namespace swimtwin
