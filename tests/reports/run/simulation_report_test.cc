#include <reports/run/simulation_report.h>

#include <tests/datasets/temporary_folder.h>
#include <tests/reports/synthetic_run.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    RunSummary completed()
    {
      RunSummary summary;
      summary.status = "completed";
      return summary;
    }
  } // namespace

  TEST(SimulationReport, ShortRunHasWordsForWhatWasNotComputed)
  {
    const std::string text = describe(synthetic_scene(), completed());
    expect_in(text, "no displacement per period: no full period of 1.25 s was computed");
    expect_in(text, "no power imbalance: no full period was computed");
    EXPECT_EQ(text.find('%'), std::string::npos) << text;
    EXPECT_EQ(text.find("coupling iterations"), std::string::npos) << text;
  }

  TEST(SimulationReport, WithoutWorkThereIsNoImbalance)
  {
    RunSummary summary                = completed();
    summary.displacement_per_period_m = {1e-4};
    summary.net_displacement_m        = 1e-4;
    const std::string text            = describe(synthetic_scene(), summary);
    expect_in(text, "+0.10000 mm");
    expect_in(text, "no power imbalance: no magnetic work and no dissipation to compare with");
    summary.worst_power_imbalance = -0.012;
    expect_in(describe(synthetic_scene(), summary), "-1.200 % in the worst period; none over the last");
  }

  TEST(SimulationReport, AHeldHeadHasNoDisplacement)
  {
    RunSummary summary                = completed();
    summary.displacement_per_period_m = {0.};
    summary.net_displacement_m        = 0.;
    summary.power_imbalance = summary.worst_power_imbalance = 1e-4;
    summary.coupling_iterations_mean                        = 1.5;
    const std::string text = describe(synthetic_scene({"head.motion=\"fixed\""}), summary);
    expect_in(text, "no displacement: the head is held");
    expect_in(text, "power imbalance +0.010 % over the last period, +0.010 % in the worst");
    expect_in(text, "0 steps of 1.50 coupling iterations");
  }
} // namespace swimtwin
