#include <app/frame/written_files.h>
#include <datasets/files/folder_lock.h>
#include <datasets/system/provenance.h>
#include <tests/app/declared_files.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/other_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>
#include <tests/rom/example_model.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Verbs that take a second, on a small model.
    class WrittenFilesTest : public testing::Test
    {
    protected:
      WrittenFilesTest() { write_reduced_model(model, example_model({.magnetic_tail = false}), Provenance{}); }

      Outcome run(const std::string &verb, const std::vector<std::string> &options = {}) const
      {
        std::vector<std::string> arguments = {verb, model, "--output", results, "--quiet"};
        if (verb == "report")
          arguments = {verb, results, "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_in_process(arguments,
                              {{"sweep", add_sweep}, {"reconstruct", add_reconstruct}, {"report", add_report}});
      }

      std::vector<fs::path> files() const
      {
        std::vector<fs::path> found;
        for (const auto &entry : fs::recursive_directory_iterator(results))
          if (!entry.is_directory())
            found.push_back(entry.path().lexically_relative(results));
        std::sort(found.begin(), found.end());
        return found;
      }

      const TemporaryFolder folder;
      const fs::path        model = folder.path / "model.h5", results = folder.path / "results";
    };
  } // namespace

  TEST_F(WrittenFilesTest, AreAllThatAVerbWrites)
  {
    ASSERT_EQ(run("reconstruct", {"--pictures"}).code, 0);
    ASSERT_EQ(run("report").code, 0);
    expect_all_declared(results, written_by::simulate().patterns);
    fs::remove_all(results);
    ASSERT_EQ(run("sweep").code, 0);
    ASSERT_EQ(run("report").code, 0);
    expect_all_declared(results, written_by::sweep().patterns);
  }

  TEST_F(WrittenFilesTest, OfAnEarlierRunGoWithForceAndThoseOfTheUserStay)
  {
    ASSERT_EQ(run("reconstruct", {"--pictures"}).code, 0);
    ASSERT_EQ(run("report").code, 0);
    std::ofstream(results / "checkpoint.h5") << "of a simulation";
    std::ofstream(results / "pictures/photo.png") << "mine";
    std::ofstream(results / "notes.txt") << "mine";
    ASSERT_EQ(run("reconstruct", {"--force"}).code, 0);
    EXPECT_EQ(files(), (std::vector<fs::path>{"notes.txt", "pictures/photo.png", "snapshots.h5", "summary.json",
                                              "trajectory.csv"}));
  }

  TEST_F(WrittenFilesTest, AreKeptWhenTheInputIsWrong)
  {
    ASSERT_EQ(run("reconstruct", {"--pictures"}).code, 0);
    const auto before = files();
    for (const std::vector<std::string> &wrong : {std::vector<std::string>{"--set", "tail.length_m=1"},
                                                  {"--set", "time.periods=0.5"},
                                                  {"--set", "field.frequency_Hz=-1"},
                                                  {"--flow"}})
    {
      std::vector<std::string> options = wrong;
      options.push_back("--force");
      EXPECT_EQ(run("reconstruct", options).code, 2);
      EXPECT_EQ(files(), before);
    }
  }

  TEST_F(WrittenFilesTest, AreNotReadWhileARunGoesOn)
  {
    ASSERT_EQ(run("sweep").code, 0);
    {
      const OtherProcess other([&] { new FolderLock(results, "swimtwin sweep elsewhere"); });
      for (const char *verb : {"report", "sweep", "reconstruct"})
      {
        const Outcome outcome = run(verb, {"--force"});
        EXPECT_EQ(outcome.code, 2);
        expect_in(outcome.errors, "swimtwin sweep elsewhere");
        EXPECT_EQ(outcome.errors.find("--resume"), std::string::npos);
        EXPECT_EQ(outcome.errors.find("--force"), std::string::npos);
      }
    }
    EXPECT_EQ(run("report").code, 0);
  }

  TEST_F(WrittenFilesTest, OfARunInAFolderBelowAreMissedAloud)
  {
    ASSERT_EQ(run("sweep").code, 0);
    fs::create_directory(results / "run-2");
    const OtherProcess other([&] { new FolderLock(results / "run-2", "swimtwin simulate open-2d"); });
    const Outcome      outcome = run("report");
    EXPECT_EQ(outcome.code, 0);
    expect_in(outcome.errors, "a run goes on in " + (results / "run-2").string());
  }

  TEST(WrittenFiles, AreAllInTheDocumentation)
  {
    const std::string text = content(fs::path(places::source) / "docs/file-formats.md");
    for (const WrittenFiles &files : all_written_files())
      for (const fs::path pattern : files.patterns)
        expect_in(text, pattern.stem().string());
  }
} // namespace swimtwin
