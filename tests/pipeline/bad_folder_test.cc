#include <tests/pipeline/simulation.h>

namespace swimtwin
{
  namespace
  {
    const ShrunkScene short_run = coarse_swimmer(20, 0.1);

    std::vector<std::string> arguments_of(const std::string &verb, const std::filesystem::path &folder)
    {
      std::vector<std::string> arguments{verb, "--output", folder};
      for (const auto &word : short_run.arguments())
        arguments.push_back(word);
      return arguments;
    }
  } // namespace

  // Tests may run as root, whom no permission stops: a file in the folder's place does.
  TEST(BadFolder, AFileInItsPlaceIsRefusedAndKept)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write("run", "mine");
    for (const char *verb : {"simulate", "resistance", "plan"})
      for (const auto &output : {file, file / "below"})
        expect_failure(run_tool(arguments_of(verb, output)), 2, {output.string(), "choose another --output"});
    EXPECT_EQ(content(file), "mine");
    EXPECT_EQ(n_files(folder.path), 1);
  }

  TEST(BadFolder, ExistingResultsAreKeptByteForByteWithoutForce)
  {
    for (const auto &[verb, result] : {std::pair("simulate", "trajectory.csv"), std::pair("simulate", "summary.json"),
                                       std::pair("simulate", "snapshots.h5"),
                                       std::pair("resistance", "resistance.json"), std::pair("plan", "plan.txt")})
    {
      const TemporaryFolder folder;
      folder.write(result, "an earlier result");
      folder.write("notes.txt", "of the user");
      expect_failure(run_tool(arguments_of(verb, folder.path)), 2, {result, "--force"});
      EXPECT_EQ(content(folder.path / result), "an earlier result");
      EXPECT_EQ(n_files(folder.path), 2);
    }
  }

  TEST(BadFolder, ForceReplacesResultsAndNothingElse)
  {
    for (const auto &[verb, result] : {std::pair("simulate", "trajectory.csv"),
                                       std::pair("resistance", "resistance.json"), std::pair("plan", "plan.txt")})
    {
      const TemporaryFolder folder;
      folder.write(result, "an earlier result");
      folder.write("notes.txt", "of the user");
      auto arguments = arguments_of(verb, folder.path);
      arguments.push_back("--force");
      EXPECT_EQ(run_tool(arguments).exit_code, 0);
      EXPECT_NE(content(folder.path / result), "an earlier result");
      EXPECT_EQ(content(folder.path / "notes.txt"), "of the user");
    }
  }
} // namespace swimtwin
