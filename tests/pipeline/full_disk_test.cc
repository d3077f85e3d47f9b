#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <sys/mount.h>

namespace swimtwin
{
  namespace
  {
    /// A file system of a given size, as long as a test. Only root may make one.
    class SmallDisk
    {
    public:
      explicit SmallDisk(const std::string &size)
          : is_there(mount("tmpfs", folder_.path.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0)
      {
      }
      SmallDisk(const SmallDisk &)            = delete;
      SmallDisk &operator=(const SmallDisk &) = delete;
      ~SmallDisk()
      {
        if (is_there)
          umount(folder_.path.c_str());
      }

      std::filesystem::path path() const { return folder_.path; }

    private:
      TemporaryFolder folder_;

    public:
      const bool is_there;
    };

    /// Fields of earlier instants may stay: each is whole.
    void expect_no_results_in(const std::filesystem::path &folder)
    {
      for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
      {
        const auto name = entry.path().filename().string();
        EXPECT_EQ(name.find("partial"), std::string::npos) << name << " is left";
        EXPECT_TRUE(name != "trajectory.csv" && name != "summary.json" && name != "snapshots.h5") << name << " is left";
      }
    }

    const ShrunkScene run_without_checkpoint = coarse_swimmer(20, 0.1), run_with_checkpoint = coarse_swimmer(20, 0.5),
                      run_with_fields = run_without_checkpoint.with({"output.fields_per_period=20"});
  } // namespace

  TEST(FullDisk, EndsARunWithOneSentenceAndNoPartialFile)
  {
    for (const auto &scene : {run_without_checkpoint, run_with_checkpoint, run_with_fields})
    {
      const SmallDisk disk("8k");
      if (!disk.is_there)
        GTEST_SKIP() << "no right to mount a small disk";
      expect_failure(run_tool(simulate_arguments(scene, disk.path())), 1, {disk.path().string(), "space"});
      expect_no_results_in(disk.path());
    }
  }

  TEST(FullDisk, EndsAResistanceWithOneSentenceAndNoPartialFile)
  {
    const SmallDisk disk("4k");
    if (!disk.is_there)
      GTEST_SKIP() << "no right to mount a small disk";
    std::ofstream(disk.path() / "filler") << std::string(4000, 'x');
    std::vector<std::string> arguments{"resistance", "--output", disk.path()};
    for (const auto &word : run_without_checkpoint.arguments())
      arguments.push_back(word);
    expect_failure(run_tool(arguments), 1, {"resistance.json", "space"});
    EXPECT_EQ(n_files(disk.path()), 1);
  }

  TEST(FullDisk, EndsAReportWithOneSentenceAndNoPartialFile)
  {
    const SmallDisk disk("4k");
    if (!disk.is_there)
      GTEST_SKIP() << "no right to mount a small disk";
    const TemporaryFolder folder;
    folder.write("displacement_frequency.csv", "young_modulus_Pa,frequency_Hz,displacement_m\n1e5,0.8,1.7e-4\n");
    std::ofstream(disk.path() / "filler") << std::string(4000, 'x');
    expect_failure(run_tool({"report", folder.path, "--output", disk.path()}), 1, {"report.html", "space"});
    EXPECT_EQ(n_files(disk.path()), 1);
  }

  // What was there before is there afterwards.
  TEST(FullDisk, AFailedForceKeepsTheOldResultItCouldNotReplace)
  {
    const SmallDisk disk("8k"); // a page for the old result and one for the folder's other file
    if (!disk.is_there)
      GTEST_SKIP() << "no right to mount a small disk";
    std::ofstream(disk.path() / "resistance.json") << "an earlier result";
    std::ofstream(disk.path() / "filler") << std::string(4000, 'x');
    std::vector<std::string> arguments{"resistance", "--force", "--output", disk.path()};
    for (const auto &word : run_without_checkpoint.arguments())
      arguments.push_back(word);
    expect_failure(run_tool(arguments), 1, {"resistance.json", "space"});
    EXPECT_EQ(content(disk.path() / "resistance.json"), "an earlier result");
  }

  // The other rank waits for the writer: it is told to end, after the sentence.
  TEST(FullDisk, EndsTheRankThatKnowsNothingOfIt)
  {
    const SmallDisk disk("8k");
    if (!disk.is_there)
      GTEST_SKIP() << "no right to mount a small disk";
    std::vector<std::string> words{
        "timeout",         "120", "env", "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "mpirun",
        "--oversubscribe", "-n",  "2"};
    for (const auto &word : tool(simulate_arguments(run_with_checkpoint, disk.path())))
      words.push_back(word);
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(outcome.err.find("swimtwin: cannot write"), 0) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("swimtwin: "), 0) << outcome.err;
  }

  TEST(FullDisk, AFileThatMayNotGrowIsLikeOne)
  {
    const TemporaryFolder folder;
    std::string           line = "ulimit -f 4; exec " + std::string(places::tool);
    for (const std::string &word : simulate_arguments(run_without_checkpoint, folder.path / "run"))
      line += " " + word;
    expect_failure(run({"bash", "-c", line}), 1, {(folder.path / "run").string()});
    expect_no_results_in(folder.path / "run");
  }
} // namespace swimtwin
