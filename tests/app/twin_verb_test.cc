#include <app/written_files.h>
#include <tests/app/declared_files.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>

#include <fstream>
#include <sstream>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    class TwinVerbTest : public testing::Test
    {
    protected:
      Outcome run(const std::vector<std::string> &arguments) const
      {
        return run_in_process(arguments, {{"twin", add_twin}, {"lab", add_lab}});
      }
      fs::path write(const char *name, const std::string &text) const
      {
        std::ofstream(folder.path / name) << text;
        return folder.path / name;
      }
      static std::string content(const fs::path &file)
      {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
      }

      const TemporaryFolder folder;
      const std::string     model = std::string(places::models) + "/open-2d.h5";
      const fs::path        config =
                         write("twin.toml",
                               "[field]\nbx_T = 4e-3\nby_T = 4e-3\nfrequency_Hz = 0.8\n[output]\nsave_every = 50\n"),
                     lab = write("lab.toml", "duration_s = 4\n[coils]\nbx_T = 4e-3\nby_T = 4e-3\nfrequency_Hz = 0.8\n"),
                     results = folder.path / "results";
    };
  } // namespace

  TEST_F(TwinVerbTest, ReplaysWhatALaboratorySaid)
  {
    const Outcome imagined = run({"lab", model, lab});
    ASSERT_EQ(imagined.code, 0) << imagined.errors;
    const fs::path recording = write("lab.jsonl", imagined.output);
    const Outcome  outcome   = run({"twin", model, config, "--replay", recording, "--output", results});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_NE(outcome.output.find("\"type\":\"estimate\""), std::string::npos);
    expect_all_declared(results, written_by::twin().patterns);
    const std::string table = content(results / "twin.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 121);
    EXPECT_FALSE(fs::exists(results / "twin-state.json"));
  }

  TEST_F(TwinVerbTest, GoesOnAfterAKillAsIfThereHadBeenNone)
  {
    const fs::path recording = write("lab.jsonl", run({"lab", model, lab}).output);
    ASSERT_EQ(run({"twin", model, config, "--replay", recording, "--output", results}).code, 0);
    const std::string whole = content(results / "twin.csv");
    // What a killed one leaves: a child process that ends at once in the middle.
    const fs::path    killed  = folder.path / "killed";
    const std::string command = std::string("head -n 90 ") + recording.string() +
                                " | (cat; sleep 3) | timeout -s KILL 2 " + places::tool + " twin " + model + " " +
                                config.string() + " --output " + killed.string() + " > /dev/null 2>&1";
    static_cast<void>(std::system(command.c_str()));
    ASSERT_TRUE(fs::exists(killed / "twin-state.json"));
    std::ofstream(killed / "twin.csv", std::ios::app) << "3.0,0.1"; // a row cut short
    const Outcome refused = run({"twin", model, config, "--replay", recording, "--output", killed});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.errors.find("--resume"), std::string::npos) << refused.errors;
    const Outcome resumed = run({"twin", model, config, "--replay", recording, "--output", killed, "--resume"});
    ASSERT_EQ(resumed.code, 0) << resumed.errors;
    EXPECT_EQ(content(killed / "twin.csv"), whole);
  }

  TEST_F(TwinVerbTest, ReplaysTracksAsCalibrateReadsThem)
  {
    const std::string tracks  = std::string(places::models) + "/../observations/synthetic-tracks.csv";
    const std::string paper   = std::string(places::models) + "/reference-2d.h5";
    const Outcome     outcome = run({"twin", paper, config, "--replay", tracks, "--output", results, "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output.find("\"type\":\"error\""), std::string::npos);
  }

  TEST_F(TwinVerbTest, RefusesFaultsOfItsCommandInOneSentence)
  {
    const fs::path wrong = write("wrong.toml", "[camera]\nposition_sigma = 1\n");
    for (const auto &[arguments, words] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"twin", model, wrong, "--output", results}, "position_sigma_m"},
             {{"twin", model, config, "--output", results, "--real-time"}, "--replay"},
             {{"twin", model, config, "--output", results, "--listen", "99999"}, "65535"},
             {{"twin", model, config, "--output", results, "--replay", folder.path / "none.jsonl"}, "none.jsonl"},
             {{"twin", model, config, "--output", results, "--resume"}, "leave --resume out"},
             {{"lab", model, wrong}, "position_noise"}})
    {
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.code, 2) << words;
      EXPECT_NE(outcome.errors.find(words), std::string::npos) << outcome.errors;
      fs::remove_all(results);
    }
  }
} // namespace swimtwin
