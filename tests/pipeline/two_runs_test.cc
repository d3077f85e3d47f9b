#include <tests/pipeline/simulation.h>

#include <algorithm>
#include <memory>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    const ShrunkScene long_run = coarse_swimmer(100, 3.), brief_run = coarse_swimmer(20, 0.2);

    bool has_results(const fs::path &folder)
    {
      return fs::exists(folder / "summary.json") || fs::exists(folder / "trajectory.csv");
    }
  } // namespace

  TEST(TwoRuns, TheSecondInAFolderIsToldOfTheFirst)
  {
    const TemporaryFolder folder;
    ChildProcess          first(tool(simulate_arguments(long_run, folder.path)));
    ASSERT_TRUE(first.wait_for_file(folder.path / "checkpoint.h5"));
    for (const std::vector<std::string> &options :
         {std::vector<std::string>{}, {"--resume"}, {"--force"}, {"--force", "--set", "time.periods=0.2"}})
    {
      const Outcome second = run_tool(simulate_arguments(long_run, folder.path, options));
      expect_failure(second, 2, {folder.path.string() + " is in use by process ", "simulate", "wait for the end"});
      for (const char *wrong : {"interrupted", "--resume", "add --force", "with --force"})
        EXPECT_EQ(second.err.find(wrong), std::string::npos) << second.err;
    }
    expect_failure(run_tool({"report", folder.path}), 2, {"a run goes on in " + folder.path.string()});
    EXPECT_TRUE(first.kill()) << "the first must not have been disturbed";
    simulate(brief_run, folder.path, {"--force"});
    EXPECT_EQ(n_files(folder.path), 4u) << "a killed run must leave no lock";
  }

  TEST(TwoRuns, StartedTogetherOneOfThemRuns)
  {
    const TemporaryFolder                      folder;
    std::vector<std::unique_ptr<ChildProcess>> runs;
    for (int i = 0; i < 3; ++i)
      runs.push_back(std::make_unique<ChildProcess>(tool(simulate_arguments(brief_run, folder.path))));
    std::vector<int> codes;
    for (const auto &run : runs)
      codes.push_back(run->wait().exit_code);
    EXPECT_EQ(std::count(codes.begin(), codes.end(), 0), 1);
    EXPECT_EQ(std::count(codes.begin(), codes.end(), 2), 2);
    EXPECT_EQ(read_motion(folder.path).summary.status, "completed");
    EXPECT_EQ(n_files(folder.path), 4u);
  }

  TEST(TwoRuns, AForcedOneStartsInAFolderWithoutTheOld)
  {
    const TemporaryFolder folder;
    simulate(brief_run.with({"output.fields_per_period=20"}), folder.path, {"--pictures"});
    EXPECT_EQ(run_tool({"report", folder.path}).exit_code, 0);
    folder.write("notes.txt", "mine");
    folder.write("pictures/photo.png", "mine");
    ChildProcess run(tool(simulate_arguments(long_run, folder.path, {"--force"})));
    ASSERT_TRUE(run.wait_until([&] { return !has_results(folder.path); }));
    ASSERT_TRUE(run.wait_for_file(folder.path / "checkpoint.h5"));
    EXPECT_FALSE(has_results(folder.path));
    EXPECT_FALSE(fs::exists(folder.path / "report.html"));
    EXPECT_FALSE(fs::exists(folder.path / "snapshots.h5"));
    EXPECT_FALSE(fs::exists(folder.path / "fields"));
    EXPECT_EQ(n_files(folder.path / "pictures"), 1u);
    EXPECT_EQ(content(folder.path / "pictures/photo.png"), "mine");
    EXPECT_EQ(content(folder.path / "notes.txt"), "mine");
  }

  // Killed while it meshes: the old results are aside, and nothing of the new run is there.
  TEST(TwoRuns, AForcedOneThatIsKilledAtItsStartLosesNothing)
  {
    const TemporaryFolder folder;
    simulate(brief_run, folder.path);
    const std::string before = content(folder.path / "trajectory.csv");
    {
      ChildProcess run(tool(simulate_arguments(long_run, folder.path, {"--force"})));
      ASSERT_TRUE(run.wait_until([&] { return !has_results(folder.path); }));
      ASSERT_TRUE(run.kill());
    }
    if (fs::exists(folder.path / "checkpoint.h5"))
      GTEST_SKIP() << "it was faster than the kill";
    expect_failure(run_tool(simulate_arguments(long_run, folder.path)), 2, {"already holds trajectory.csv"});
    EXPECT_EQ(content(folder.path / "trajectory.csv"), before);
    EXPECT_EQ(n_files(folder.path), 4u);
  }

  // trajectory.csv has the columns of a field program.
  TEST(TwoRuns, AForcedOneDoesNotRemoveTheFieldThatItPlays)
  {
    const TemporaryFolder folder;
    simulate(brief_run, folder.path);
    const std::string program = (folder.path / "trajectory.csv").string();
    const auto        replay  = brief_run.with({"field={program=\"" + program + "\", period_s=0.28}"});
    expect_failure(run_tool(simulate_arguments(replay, folder.path, {"--force"})), 2,
                   {"--force would replace " + program + ", which this run reads"});
    EXPECT_EQ(n_files(folder.path), 4u);
  }

  TEST(TwoRuns, WrongInputWithForceLosesNothing)
  {
    const TemporaryFolder folder;
    simulate(brief_run, folder.path);
    const std::string before = content(folder.path / "summary.json");
    for (const char *wrong : {"tail.young_modulus_Pa=-1", "time.steps_per_period=2", "field.program=\"none.csv\""})
      EXPECT_EQ(run_tool(simulate_arguments(brief_run.with({wrong}), folder.path, {"--force"})).exit_code, 2);
    EXPECT_EQ(content(folder.path / "summary.json"), before);
    EXPECT_EQ(n_files(folder.path), 4u);
  }
} // namespace swimtwin
