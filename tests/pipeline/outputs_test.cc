#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <nlohmann/json.hpp>

#include <sstream>

namespace swimtwin
{
  namespace
  {
    /// Reference swimmer of the case files, one period of 20 steps.
    const ShrunkScene one_period = coarse_swimmer(20, 1.);

    std::vector<std::string> csv_lines(const std::filesystem::path &file)
    {
      std::vector<std::string> lines;
      std::istringstream       stream(content(file));
      for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
      return lines;
    }

    std::vector<std::string> names_in(const std::filesystem::path &folder)
    {
      std::vector<std::string> names;
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename());
      std::sort(names.begin(), names.end());
      return names;
    }
  } // namespace

  TEST(Outputs, ARunLeavesTrajectorySummaryAndSnapshotsAndNothingElse)
  {
    const TemporaryFolder folder;
    simulate(one_period, folder.path / "run");
    EXPECT_EQ(names_in(folder.path), std::vector<std::string>{"run"});
    EXPECT_EQ(names_in(folder.path / "run"),
              (std::vector<std::string>{"flow.h5", "snapshots.h5", "summary.json", "trajectory.csv"}));
  }

  TEST(Outputs, TheTrajectoryHasTheContractsColumnsAndARowPerStep)
  {
    const TemporaryFolder folder;
    simulate(one_period, folder.path);
    const auto lines = csv_lines(folder.path / "trajectory.csv");
    EXPECT_EQ(lines.size(), 1 + 21);
    EXPECT_EQ(lines.front().substr(0, lines.front().find(",bx_T")),
              "time_s,head_x_m,head_y_m,head_angle_rad,tail_tip_x_m,tail_tip_y_m,tail_angle_rad");
    const Trajectory trajectory = read_trajectory_csv(folder.path / "trajectory.csv");
    for (std::size_t i = 0; i < trajectory.size(); ++i)
      EXPECT_NEAR(trajectory[i].time_s, i / (0.9 * 20), 1e-12);
    EXPECT_EQ(trajectory.front().head_x_m, 0.);
    EXPECT_NEAR(trajectory.front().tail_tip_x_m, 7.75e-3, 1e-12);
  }

  TEST(Outputs, PythonReadsTheTrajectoryAsItIs)
  {
    const TemporaryFolder folder;
    simulate(one_period, folder.path);
    const Outcome outcome = run({places::python, "-B", std::string(places::checks) + "/check_tables.py", folder.path});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out, "1\n");
  }

  TEST(Outputs, TheSummaryHasTheContractsKeysAndCompletes)
  {
    const TemporaryFolder folder;
    simulate(one_period, folder.path);
    const auto summary = nlohmann::json::parse(content(folder.path / "summary.json"));
    for (const char *key : {"status", "displacement_per_period_m", "net_displacement_m", "n_unknowns", "n_steps",
                            "n_linear_solves", "linear_iterations_mean", "n_factorizations", "coupling_iterations_mean",
                            "n_remeshes", "power_imbalance", "wall_time_s", "peak_memory_MB"})
      EXPECT_TRUE(summary.contains(key)) << key;
    for (const char *key : {"program_version", "command_line", "scene_text", "scene_hash", "created", "wall_time_s"})
      EXPECT_TRUE(summary["provenance"].contains(key)) << key;
    EXPECT_EQ(summary["status"], "completed");
    EXPECT_GE(summary["n_linear_solves"], summary["n_steps"]);
  }

  // At rest the head points to -x, so head first is -x.
  TEST(Outputs, DisplacementIsPositiveHeadFirst)
  {
    const auto [summary, trajectory] = simulate(coarse_swimmer(20, 2.));
    ASSERT_EQ(summary.displacement_per_period_m.size(), 2);
    EXPECT_DOUBLE_EQ(summary.displacement_per_period_m[0], trajectory[0].head_x_m - trajectory[20].head_x_m);
    EXPECT_DOUBLE_EQ(summary.displacement_per_period_m[1], trajectory[20].head_x_m - trajectory[40].head_x_m);
    EXPECT_EQ(summary.net_displacement_m.value(), summary.displacement_per_period_m[1]);
  }

  TEST(Outputs, ASecondRunRepeatsTheFirst)
  {
    EXPECT_EQ(distance(simulate(one_period).trajectory, simulate(one_period).trajectory), 0.);
  }

  TEST(Outputs, NoSnapshotsAreWrittenWhenNoneAreAskedFor)
  {
    const TemporaryFolder folder;
    simulate(coarse_swimmer(20, 0.1).with({"output.snapshots_per_period=0"}), folder.path);
    EXPECT_TRUE(std::filesystem::exists(folder.path / "trajectory.csv"));
  }

  TEST(Outputs, TheSceneInTheSummaryRunsAgain)
  {
    const TemporaryFolder folder;
    simulate(one_period, folder.path / "first");
    const auto record = read_run_summary_json(folder.path / "first" / "summary.json");
    const auto again  = folder.write("again.toml", record.provenance.scene_text);
    simulate({again.string()}, folder.path / "second");
    const auto record_again = read_run_summary_json(folder.path / "second" / "summary.json");
    EXPECT_EQ(record_again.provenance.scene_hash, record.provenance.scene_hash);
    EXPECT_EQ(record_again.summary.displacement_per_period_m, record.summary.displacement_per_period_m);
  }
} // namespace swimtwin
