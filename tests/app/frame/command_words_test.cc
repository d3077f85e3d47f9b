#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    Outcome tool(const std::vector<std::string> &words)
    {
      return run_in_process(words,
                            {{"sweep", add_sweep}, {"reconstruct", add_reconstruct}, {"calibrate", add_calibrate}});
    }

    void expect_one_sentence(const std::vector<std::string> &words, const std::string &part)
    {
      const Outcome outcome = tool(words);
      EXPECT_EQ(outcome.code, 2) << outcome.errors;
      EXPECT_EQ(outcome.output, "");
      EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
      expect_in(outcome.errors, part);
      expect_in(outcome.errors, "--help");
    }
  } // namespace

  TEST(CommandWords, UnknownVerbsAreAnsweredByTheNearest)
  {
    expect_one_sentence({"swep"}, "there is no verb swep; the nearest is sweep");
    expect_one_sentence({"Reconstruct", "m"}, "there is no verb Reconstruct; the nearest is reconstruct");
    expect_one_sentence({""}, "the verb is empty; it is one of sweep, reconstruct, calibrate");
    expect_one_sentence({}, "a verb is missing: sweep, reconstruct, calibrate");
    expect_one_sentence({"--quiet", "sweep"}, "--quiet stands where the verb belongs; begin with one of sweep");
  }

  TEST(CommandWords, UnknownOptionsAreAnsweredByTheNearest)
  {
    expect_one_sentence({"sweep", "m", "--outptu", "x"}, "sweep has no option --outptu; the nearest is --output");
    expect_one_sentence({"sweep", "m", "--visc=1"}, "sweep has no option --visc; the nearest is");
    expect_one_sentence({"sweep", "m", "-o", "x"}, "sweep has no option -o");
  }

  TEST(CommandWords, MissingAndEmptyValuesAreRefused)
  {
    expect_one_sentence({"sweep", "m", "--output", ""}, "--output \"\": a value is missing");
    expect_one_sentence({"sweep", "m", "--output="}, "--output \"\": a value is missing");
    expect_one_sentence({"sweep", "m", "--output", " "}, "--output \"\": a value is missing");
    expect_one_sentence({"sweep", "m", "--output"}, "--output is the last word; write its value behind it");
    expect_one_sentence({"sweep", "m", "--output", "--quiet"}, "--output is followed by --quiet, which is no value");
    expect_one_sentence({"sweep", "", "--output", "x"}, "a word is empty; sweep takes model");
    EXPECT_FALSE(std::filesystem::exists("--quiet"));
  }

  TEST(CommandWords, OptionsGivenTwiceAndValuesOfFlagsAreRefused)
  {
    expect_one_sentence({"sweep", "m", "--output", "a", "--output", "b"}, "--output is given twice, as a and as b");
    expect_one_sentence({"sweep", "m", "--bx", "1", "--bx=1"}, "--bx is given twice, as 1 and as 1");
    expect_one_sentence({"sweep", "m", "--quiet=no"}, "--quiet takes no value");
  }

  TEST(CommandWords, TooManyWordsAreRefused)
  {
    expect_one_sentence({"sweep", "my", "model.h5", "--output", "x"},
                        "\"model.h5\" is a word too many; sweep takes model");
    expect_one_sentence({"calibrate", "m", "p", "q"}, "\"q\" is a word too many; calibrate takes model and problem");
    expect_one_sentence({"sweep", "m", "--", "-n"}, "\"-n\" is a word too many");
  }

  TEST(CommandWords, SettingsAreAssignments)
  {
    for (const char *setting : {"time.periods", "=2", "time.periods="})
      expect_one_sentence({"reconstruct", "m", "--output", "x", "--set", setting},
                          std::string(setting) + " is not KEY=VALUE; write for instance --set time.periods=2");
  }

  TEST(CommandWords, NegativeNumbersAreValuesAndFlagsMayBeRepeated)
  {
    // What is complained of is the model, the first thing behind the words.
    for (const auto &words : {std::vector<std::string>{"--bx", "-1e-3"},
                              {"--bx=-1e-3"},
                              {"--by", "-.5:2:7"},
                              {"--magnetization", "-1e5,1e5"},
                              {"--quiet", "--quiet"}})
    {
      std::vector<std::string> all{"sweep", "no-such-model", "--output", "unused"};
      all.insert(all.end(), words.begin(), words.end());
      expect_in(tool(all).errors, "cannot read no-such-model: ");
    }
  }

  TEST(CommandWords, HelpIsGivenWhateverFollows)
  {
    EXPECT_EQ(tool({"--help"}).code, 0);
    EXPECT_EQ(tool({"--version", "sweep"}).code, 0);
    EXPECT_EQ(tool({"sweep", "--help"}).code, 0);
  }
} // namespace swimtwin
