#include <tests/pipeline/simulation.h>
#include <tests/places.h>

namespace swimtwin
{
  namespace
  {
    /// The tool with these words, its streams as the shell is told.
    Outcome tool_with(const std::string &words, const std::string &streams)
    {
      return run({"sh", "-c", std::string(places::tool) + " " + words + " " + streams});
    }

    std::string simulate_words(const std::filesystem::path &folder)
    {
      std::string words;
      for (const std::string &word : simulate_arguments(coarse_swimmer(20, 0.1), folder))
        words += " " + word;
      return words;
    }
  } // namespace

  TEST(Streams, OutputThatCannotBeWrittenIsAFailure)
  {
    for (const char *words : {"--version", "--help", "sweep --help"})
      expect_failure(tool_with(words, "> /dev/full"), 1, {"standard output cannot be written", "No space left"});
    const TemporaryFolder folder;
    expect_failure(tool_with(simulate_words(folder.path), "> /dev/full"), 1, {"No space left"});
    EXPECT_TRUE(std::filesystem::exists(folder.path / "trajectory.csv")) << "files are another matter";
  }

  TEST(Streams, ErrorsThatNobodyCanReadKeepTheirExitCodes)
  {
    for (const char *streams : {"2>&-", "2> /dev/full", "> /dev/full 2> /dev/full", ">&- 2>&- <&-"})
    {
      EXPECT_EQ(tool_with("swim", streams).exit_code, 2) << streams;
      EXPECT_EQ(tool_with("simulate no-such-scene --output unused", streams).exit_code, 2) << streams;
    }
    EXPECT_EQ(tool_with("--version", "> /dev/full 2>&-").exit_code, 1);
  }

  TEST(Streams, WarningsThatNobodyCanReadDoNotStopASweep)
  {
    const TemporaryFolder folder;
    const std::string     words   = "sweep reference-2d --frequency 0.5 --bx 0.001 --output " + folder.path.string();
    const Outcome         outcome = tool_with(words, "2> /dev/full");
    EXPECT_EQ(outcome.exit_code, 0);
    expect_in(outcome.out, "results in");
  }

  TEST(Streams, ClosedOnesAreNotTakenForFiles)
  {
    const TemporaryFolder open, closed;
    ASSERT_EQ(tool_with(simulate_words(open.path), "").exit_code, 0);
    EXPECT_EQ(tool_with(simulate_words(closed.path), "<&- >&- 2>&-").exit_code, 0);
    EXPECT_EQ(content(closed.path / "trajectory.csv"), content(open.path / "trajectory.csv"));
    EXPECT_EQ(n_files(closed.path), n_files(open.path));
  }

  TEST(Streams, AReaderThatGoesAwayEndsNothing)
  {
    const TemporaryFolder folder;
    const Outcome         outcome = run({"bash", "-c",
                                         "set -o pipefail; " + std::string(places::tool) + simulate_words(folder.path) +
                                             " | true; echo $?; " + std::string(places::tool) + " --help | head -1"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out.substr(0, 2), "0\n");
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(std::filesystem::exists(folder.path / "trajectory.csv"));
  }
} // namespace swimtwin
