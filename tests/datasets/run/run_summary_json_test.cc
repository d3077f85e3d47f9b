#include <datasets/run/run_summary_json.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    RunRecord example_record()
    {
      RunRecord   record;
      RunSummary &summary               = record.summary;
      summary.status                    = "completed";
      summary.displacement_per_period_m = {1e-4, 2. / 3. * 1e-4};
      summary.net_displacement_m        = 2. / 3. * 1e-4;
      summary.n_unknowns                = 1;
      summary.n_steps                   = 2;
      summary.n_linear_solves           = 3;
      summary.n_factorizations          = 4;
      summary.linear_iterations_mean    = 7.5;
      summary.coupling_iterations_mean  = 2.5;
      summary.n_remeshes                = 5;
      summary.n_step_halvings           = 6;
      summary.power_imbalance           = -1e-3;
      summary.worst_power_imbalance     = 2e-3;
      summary.inertia                   = InertiaRecord{{"head"}, .001, .002, .03, .003};
      summary.wall_time_s               = 7.;
      summary.cpu_time_s                = 8.;
      summary.peak_memory_MB            = 9.;
      summary.cpu_time_of_part_s        = {{"solve", 3.}, {"assembly", 2.}};
      record.provenance = {"swimtwin 0.1.0", "simulate \"a b\"", "dimension = 2\n", "abc", "2025-01-31T12:00:00Z", 7.};
      return record;
    }
  } // namespace

  TEST(RunSummaryJson, HasTheKeysOfTheContract)
  {
    const TemporaryFolder folder;
    write_run_summary_json(folder.path / "summary.json", example_record());
    const std::string text = content(folder.path / "summary.json");
    for (const char *key : {"status", "displacement_per_period_m", "net_displacement_m", "n_unknowns", "n_steps",
                            "n_linear_solves", "linear_iterations_mean", "n_factorizations", "coupling_iterations_mean",
                            "n_remeshes", "power_imbalance", "wall_time_s", "peak_memory_MB", "n_step_halvings",
                            "worst_power_imbalance", "inertia", "cpu_time_s", "cpu_time_of_part_s", "provenance"})
      expect_in(text, "\n  \"" + std::string(key) + "\": ");
    expect_in(text, "\"status\": \"completed\"");
  }

  TEST(RunSummaryJson, RoundTripKeepsEverything)
  {
    const TemporaryFolder folder;
    const RunRecord       written = example_record();
    write_run_summary_json(folder.path / "summary.json", written);
    const RunRecord read = read_run_summary_json(folder.path / "summary.json");
    write_run_summary_json(folder.path / "again.json", read);
    EXPECT_EQ(content(folder.path / "summary.json"), content(folder.path / "again.json"));
    EXPECT_EQ(read.summary.displacement_per_period_m, written.summary.displacement_per_period_m);
    EXPECT_EQ(read.summary.cpu_time_of_part_s, written.summary.cpu_time_of_part_s);
    EXPECT_EQ(read.summary.n_factorizations, 4);
    EXPECT_EQ(read.summary.linear_iterations_mean, 7.5);
    ASSERT_TRUE(read.summary.inertia.has_value());
    EXPECT_EQ(read.summary.inertia->kept, std::vector<std::string>{"head"});
    EXPECT_EQ(read.summary.inertia->head_share, .03);
    EXPECT_EQ(read.provenance.scene_text, "dimension = 2\n");
  }

  TEST(RunSummaryJson, NaNIsNullWithAStatus)
  {
    const TemporaryFolder folder;
    RunRecord             record                = example_record();
    record.summary.power_imbalance              = std::nan("");
    record.summary.displacement_per_period_m[1] = HUGE_VAL;
    write_run_summary_json(folder.path / "summary.json", record);
    const std::string text = content(folder.path / "summary.json");
    expect_in(text, "\"power_imbalance\": null");
    expect_in(text, "\"status\": \"failed: displacement_per_period_m, power_imbalance not finite\"");
    EXPECT_FALSE(read_run_summary_json(folder.path / "summary.json").summary.power_imbalance.has_value());
  }

  TEST(RunSummaryJson, NotComputedIsNullInACompletedRun)
  {
    const TemporaryFolder folder;
    RunRecord             record             = example_record();
    record.summary.displacement_per_period_m = {};
    record.summary.net_displacement_m = record.summary.power_imbalance = record.summary.worst_power_imbalance =
        record.summary.coupling_iterations_mean                        = std::nullopt;
    write_run_summary_json(folder.path / "summary.json", record);
    const std::string text = content(folder.path / "summary.json");
    for (const char *key : {"net_displacement_m", "power_imbalance", "worst_power_imbalance",
                            "coupling_iterations_mean", "work_of_last_period"})
      expect_in(text, "\n  \"" + std::string(key) + "\": null");
    expect_in(text, "\"displacement_per_period_m\": []");
    expect_in(text, "\"status\": \"completed\"");
    const RunSummary read = read_run_summary_json(folder.path / "summary.json").summary;
    EXPECT_FALSE(read.net_displacement_m.has_value());
    EXPECT_FALSE(read.worst_power_imbalance.has_value());
  }

  TEST(RunSummaryJson, RunsOfEarlierVersionsHaveNoWorks)
  {
    const TemporaryFolder folder;
    RunRecord             record       = example_record();
    record.summary.work_of_last_period = WorkBalance{1., 2., 3., 4.};
    write_run_summary_json(folder.path / "summary.json", record);
    EXPECT_EQ(read_run_summary_json(folder.path / "summary.json").summary.work_of_last_period->stored_J_m, 4.);
    std::string text  = content(folder.path / "summary.json");
    const auto  begin = text.find("  \"work_of_last_period\"");
    text.erase(begin, text.find('}', begin) + 3 - begin);
    EXPECT_FALSE(read_run_summary_json(folder.write("earlier.json", text)).summary.work_of_last_period.has_value());
    auto json = nlohmann::json::parse(content(folder.path / "summary.json"));
    json.erase("linear_iterations_mean");
    EXPECT_FALSE(
        read_run_summary_json(folder.write("earlier.json", json.dump())).summary.linear_iterations_mean.has_value());
  }

  TEST(RunSummaryJson, NamesAMissingEntry)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write("summary.json", "{\"status\": 3}");
    expect_in(message_of<InputError>([&] { read_run_summary_json(file); }), "summary.json: the entry status");
    const auto broken = folder.write("broken.json", "{");
    expect_in(message_of<InputError>([&] { read_run_summary_json(broken); }), "broken.json was cut short");
  }
} // namespace swimtwin
