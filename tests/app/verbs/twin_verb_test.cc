#include <app/frame/written_files.h>
#include <tests/app/declared_files.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>
#include <tests/twin/run/log_check.h>

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
    expect_log_as_table(results / "twin.h5", results / "twin.csv");
    EXPECT_FALSE(fs::exists(results / "twin-state.json"));
  }

  TEST_F(TwinVerbTest, LosesNothingToARecordingThatCannotBeRead)
  {
    const fs::path right    = write("lab.jsonl", run({"lab", model, lab}).output);
    const auto     replayed = [&](const fs::path &recording) {
      return run({"twin", model, config, "--replay", recording, "--output", results, "--force"});
    };
    ASSERT_EQ(replayed(right).code, 0);
    const std::string before = content(results / "twin.csv");
    for (const fs::path &wrong : {folder.path / "missing.csv", write("wrong.csv", "time_s,x_px,y_px\n0,1,2\n")})
      EXPECT_EQ(replayed(wrong).code, 2);
    EXPECT_EQ(content(results / "twin.csv"), before);
    EXPECT_TRUE(fs::exists(results / "twin.json"));
    EXPECT_EQ(
        run({"twin", model, config, "--replay", folder.path / "missing.csv", "--output", folder.path / "new"}).code, 2);
    EXPECT_FALSE(fs::exists(folder.path / "new"));
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
    expect_log_as_table(killed / "twin.h5", killed / "twin.csv");
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

  /// A laboratory whose coils play what a twin in another process says.
  class SteeredTwinTest : public TwinVerbTest
  {
  protected:
    void SetUp() override
    {
      write("goal.toml", "kind = \"closed-loop\"\n[path]\nshape = \"circle\"\nsize_m = 7.75e-3\n"
                         "[loop]\nplant = \"external\"\ndeadline_s = 0\nwarm_up_periods = 2.0\n");
      write("steered-twin.toml", "[goal]\nfile = \"goal.toml\"\n");
      write("steered-lab.toml",
            "duration_s = 5\n[camera]\nlatency_s = 0.1\n[coils]\nsteered = true\nfrequency_Hz = 0.9\n");
    }
    std::string place(const char *name) const { return (folder.path / name).string(); }
    std::string twin() const
    {
      return std::string(places::tool) + " twin " + model + " " + place("steered-twin.toml") + " --output " +
             place("twin");
    }
    std::string laboratory() const
    {
      return std::string(places::tool) + " lab " + model + " " + place("steered-lab.toml") + " --output " +
             place("lab");
    }
    int shell(const std::string &commands) const
    {
      return std::system(("cd " + folder.path.string() + "; " + commands).c_str());
    }
    void expect_steered() const
    {
      const std::string summary = content(folder.path / "twin" / "twin.json");
      EXPECT_NE(summary.find("\"phase\": \"following\""), std::string::npos) << summary;
      EXPECT_NE(summary.find("\"errors\": 0"), std::string::npos) << summary;
      const std::string frames    = content(folder.path / "twin" / "twin.csv"),
                        truth     = content(folder.path / "lab" / "truth.csv"),
                        decisions = content(folder.path / "twin" / "steering.csv");
      EXPECT_EQ(std::count(frames.begin(), frames.end(), '\n'),
                std::count(truth.begin(), truth.end(), '\n')); // none lost
      EXPECT_NEAR(static_cast<double>(std::count(decisions.begin(), decisions.end(), '\n')), 101., 2.);
      expect_all_declared(folder.path / "twin", written_by::twin().patterns);
    }
  };

  TEST_F(SteeredTwinTest, LeadsALaboratoryOverAPort)
  {
    ASSERT_EQ(shell(twin() +
                    " --listen 0 2> said & for i in $(seq 100); do grep -q listening said && break; sleep 0.1; "
                    "done; " +
                    laboratory() + " --connect $(sed -n 's/.*127.0.0.1:\\([0-9]*\\);.*/\\1/p' said) && wait"),
              0);
    expect_steered();
  }

  TEST_F(SteeredTwinTest, LeadsALaboratoryOverTwoPipes)
  {
    ASSERT_EQ(shell("mkfifo commands && " + laboratory() + " --commands commands | " + twin() + " > commands"), 0);
    expect_steered();
  }

  TEST_F(SteeredTwinTest, SaysWhatIsMissing)
  {
    const Outcome alone = run({"lab", model, place("steered-lab.toml")});
    EXPECT_EQ(alone.code, 2);
    EXPECT_NE(alone.errors.find("--connect PORT"), std::string::npos) << alone.errors;
    const Outcome nobody = run({"lab", model, place("steered-lab.toml"), "--connect", "1"});
    EXPECT_EQ(nobody.code, 2);
    EXPECT_NE(nobody.errors.find("start `swimtwin twin"), std::string::npos) << nobody.errors;
    const Outcome no_pipe = run({"lab", model, place("steered-lab.toml"), "--commands", place("none")});
    EXPECT_EQ(no_pipe.code, 2);
    EXPECT_NE(no_pipe.errors.find("mkfifo"), std::string::npos) << no_pipe.errors;
    const Outcome recorded =
        run({"twin", model, place("steered-twin.toml"), "--output", place("twin"), "--replay", write("a.jsonl", "")});
    EXPECT_EQ(recorded.code, 2);
    EXPECT_NE(recorded.errors.find("cannot be steered"), std::string::npos) << recorded.errors;
    write("steered-lab.toml", "[coils]\nsteered = true\nbx_T = 4e-3\n");
    EXPECT_NE(run({"lab", model, place("steered-lab.toml")}).errors.find("stands beside steered"), std::string::npos);
    write("steered-lab.toml", "[coils]\nticks_per_second = 10.0\n");
    EXPECT_NE(run({"lab", model, place("steered-lab.toml")}).errors.find("is of steered coils"), std::string::npos);
  }
} // namespace swimtwin
