#include <datasets/files/output_claim.h>
#include <datasets/system/error.h>
#include <tests/datasets/other_process.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    const WrittenFiles example_run{
        "simulate", {"summary.json", "trajectory.csv", "checkpoint.h5"}, "checkpoint.h5", ""};
    const WrittenFiles training{"train", {"model.h5", "samples.h5"}, "", "model.h5"};

    OutputRequest request_for(const fs::path &folder, const bool force = false, const WrittenFiles &files = example_run)
    {
      return {folder, files, {}, "swimtwin simulate", force};
    }

    std::string refusal_to_claim(const OutputRequest &of)
    {
      return message_of<InputError>([&] { OutputClaim(of, {example_run, training}); });
    }
  } // namespace

  TEST(OutputClaim, MakesNestedFolders)
  {
    const TemporaryFolder folder;
    OutputClaim           claim(request_for(folder.path / "a" / "b"), {example_run});
    EXPECT_TRUE(fs::is_directory(folder.path / "a" / "b"));
  }

  TEST(OutputClaim, RefusesAFileInItsPlace)
  {
    const TemporaryFolder folder;
    const fs::path        file = folder.write("result", "text");
    expect_in(refusal_to_claim(request_for(file)), file.string());
    expect_in(refusal_to_claim(request_for(file / "inside")), "--output");
  }

  TEST(OutputClaim, RefusesEarlierResultsWithoutForce)
  {
    const TemporaryFolder folder;
    folder.write("trajectory.csv", "old");
    expect_in(refusal_to_claim(request_for(folder.path)),
              "already holds trajectory.csv; choose another --output, or add --force");
    EXPECT_EQ(n_files(folder.path), 1u);
    EXPECT_NO_THROW(OutputClaim(request_for(folder.path, false, training), {example_run, training}));
  }

  TEST(OutputClaim, TellsAnInterruptedRun)
  {
    const TemporaryFolder folder;
    folder.write("checkpoint.h5", "half");
    expect_in(refusal_to_claim(request_for(folder.path)),
              "holds an interrupted run of simulate: go on with --resume, or start");
    folder.write("samples.h5", "half");
    expect_in(refusal_to_claim(request_for(folder.path, false, training)),
              "holds an interrupted run of train: go on with --resume");
    folder.write("model.h5", "whole");
    expect_in(refusal_to_claim(request_for(folder.path, false, training)), "already holds model.h5");
  }

  TEST(OutputClaim, IsRefusedWhileAnotherRunGoesOnAndSaysNothingOfForce)
  {
    const TemporaryFolder folder;
    folder.write("checkpoint.h5", "half");
    const OtherProcess other([&] {
      new OutputClaim(
          [&] {
            OutputRequest going_on = request_for(folder.path);
            going_on.resume        = true;
            return going_on;
          }(),
          {example_run});
    });
    for (const bool force : {false, true})
    {
      const std::string message = refusal_to_claim(request_for(folder.path, force));
      expect_in(message, "is in use by process");
      EXPECT_EQ(message.find("--force"), std::string::npos);
      EXPECT_EQ(message.find("--resume"), std::string::npos);
      EXPECT_EQ(message.find("interrupted"), std::string::npos);
    }
    EXPECT_EQ(content(folder.path / "checkpoint.h5"), "half");
  }

  TEST(OutputClaim, WithForceClearsTheFolderUntilItBeginsOrFails)
  {
    const TemporaryFolder folder;
    folder.write("trajectory.csv", "old");
    {
      OutputClaim claim(request_for(folder.path, true), {example_run});
      EXPECT_FALSE(fs::exists(folder.path / "trajectory.csv"));
      expect_in(claim.settle(), "the earlier results in " + folder.path.string() + " are kept");
    }
    EXPECT_EQ(content(folder.path / "trajectory.csv"), "old");
    {
      OutputClaim claim(request_for(folder.path, true), {example_run});
      claim.begin();
      EXPECT_EQ(claim.settle(), "");
    }
    EXPECT_EQ(n_files(folder.path), 0u);
    folder.write("trajectory.csv", "old");
    {
      OutputClaim claim(request_for(folder.path, true), {example_run});
      folder.write("summary.json", "failed");
      expect_in(claim.settle(), "are gone");
    }
    EXPECT_EQ(n_files(folder.path), 1u);
  }

  TEST(OutputClaim, NeverReplacesWhatTheRunReads)
  {
    const TemporaryFolder folder;
    const fs::path        file = folder.write("trajectory.csv", "old");
    fs::create_symlink(file, folder.path / "link.csv");
    OutputRequest of = request_for(folder.path, true);
    of.inputs        = {folder.path / "link.csv"};
    expect_in(refusal_to_claim(of), "--force would replace " + file.string() + ", which this run reads");
    EXPECT_EQ(content(file), "old");
  }

  TEST(OutputClaim, RemovesWhatKilledRunsLeftHalfWritten)
  {
    const TemporaryFolder folder;
    folder.write(".summary.json.77-abcdef01.partial", "half");
    folder.write(".mine.partial", "mine");
    OutputRequest of = request_for(folder.path);
    of.resume        = true;
    OutputClaim claim(of, {example_run});
    EXPECT_FALSE(fs::exists(folder.path / ".summary.json.77-abcdef01.partial"));
    EXPECT_TRUE(fs::exists(folder.path / ".mine.partial"));
  }
} // namespace swimtwin
