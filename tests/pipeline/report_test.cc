#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <fmt/format.h>

#include <cstdlib>

namespace swimtwin
{
  namespace
  {
    namespace fs = std::filesystem;

    Outcome report(const fs::path &folder, const std::vector<std::string> &options = {})
    {
      std::vector<std::string> arguments{"report", folder};
      arguments.insert(arguments.end(), options.begin(), options.end());
      return run_tool(arguments);
    }

    /// What check_page.py prints: the number of pictures.
    int n_pictures(const fs::path &page)
    {
      const Outcome outcome = run({places::python, "-B", std::string(places::checks) + "/check_page.py", page});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      return outcome.exit_code == 0 ? std::stoi(outcome.out) : -1;
    }

    bool gnuplot_is_there()
    {
      return run({"gnuplot", "--version"}).exit_code == 0;
    }

    /// One simulation for all tests.
    class Report : public ::testing::Test
    {
    protected:
      void SetUp() override { fs::copy(simulated(), folder.path / "run"); }

      static fs::path simulated()
      {
        static const TemporaryFolder kept;
        if (!fs::exists(kept.path / "run"))
          simulate(coarse_swimmer(20, 1.), kept.path / "run");
        return kept.path / "run";
      }

      const TemporaryFolder folder;
      const fs::path        run_folder = folder.path / "run", page = run_folder / "report.html";
    };

    const std::string table_text = "young_modulus_Pa,frequency_Hz,displacement_m\n1e5,0.4,1e-4\n1e5,0.8,1.7e-4\n";
  } // namespace

  TEST_F(Report, OfARunIsOneFileWithAllItsPictures)
  {
    const std::size_t n_before = n_files(run_folder);
    const Outcome     outcome  = report(run_folder);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_in(outcome.out, page.string());
    EXPECT_EQ(n_files(run_folder), n_before + 1);
    EXPECT_EQ(n_pictures(page), gnuplot_is_there() ? 6 : 0);
    const RunRecord record = read_run_summary_json(run_folder / "summary.json");
    expect_in(content(page), record.provenance.scene_hash);
    expect_in(content(page), fmt::format("<td>{}</td>", record.summary.n_unknowns));
  }

  TEST_F(Report, GoesToTheOutputFolderAndNowhereElse)
  {
    const std::size_t n_before = n_files(run_folder);
    EXPECT_EQ(report(run_folder, {"--output", folder.path / "page"}).exit_code, 0);
    EXPECT_EQ(n_files(run_folder), n_before);
    EXPECT_EQ(n_files(folder.path / "page"), 1u);
  }

  TEST_F(Report, ReplacesAPageOnlyWithForce)
  {
    folder.write("run/report.html", "mine");
    expect_failure(report(run_folder), 2, {"report.html", "--force"});
    EXPECT_EQ(content(page), "mine");
    const Outcome outcome = report(run_folder, {"--force", "--quiet"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, "");
    n_pictures(page);
  }

  TEST_F(Report, WithoutGnuplotHasNoPicturesAndAWarningThatSaysSo)
  {
    const Outcome outcome = run({"env", "PATH=" + folder.path.string(), places::tool, "report", run_folder});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_in(outcome.err, "gnuplot is not installed");
    expect_in(content(page), "gnuplot is not installed");
    EXPECT_EQ(n_pictures(page), 0);
  }

  TEST_F(Report, WithAGnuplotThatFailsHasNoPicturesAndSaysHowItFailed)
  {
    fs::permissions(folder.write("gnuplot", "#!/bin/sh\nexit 1\n"), fs::perms::owner_all);
    const std::string path    = fmt::format("PATH={}:{}", folder.path.string(), std::getenv("PATH"));
    const Outcome     outcome = run({"env", path, places::tool, "report", run_folder});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_in(outcome.err, "`gnuplot --version` fails: it ended with exit code 1");
    expect_in(content(page), "`gnuplot --version` fails");
    EXPECT_EQ(n_pictures(page), 0);
  }

  TEST_F(Report, OfARunThatFailedSaysWhy)
  {
    RunRecord record      = read_run_summary_json(run_folder / "summary.json");
    record.summary.status = "failed: a made-up cause";
    write_run_summary_json(run_folder / "summary.json", record);
    EXPECT_EQ(report(run_folder).exit_code, 0);
    expect_in(content(page), "<p class=\"verdict bad\">failed: a made-up cause");
    EXPECT_EQ(n_pictures(page), 0);
  }

  TEST_F(Report, OfARunWithoutItsTrajectoryWarns)
  {
    fs::remove(run_folder / "trajectory.csv");
    const Outcome outcome = report(run_folder, {"--quiet"});
    EXPECT_EQ(outcome.exit_code, 0);
    expect_in(outcome.err, "trajectory.csv is missing");
    EXPECT_EQ(n_pictures(page), 0);
  }

  TEST_F(Report, OfASweepOfRunsLinksTheirPages)
  {
    EXPECT_EQ(report(run_folder).exit_code, 0);
    EXPECT_EQ(report(folder.path).exit_code, 0);
    EXPECT_EQ(n_pictures(folder.path / "report.html"), 0); // one frequency is no curve
    expect_in(content(folder.path / "report.html"), "<a href=\"run/report.html\">run</a>");
  }

  TEST_F(Report, OfATableShowsItsCurve)
  {
    folder.write("displacement_frequency.csv", table_text);
    EXPECT_EQ(report(folder.path).exit_code, 0);
    EXPECT_EQ(n_pictures(folder.path / "report.html"), gnuplot_is_there() ? 1 : 0);
  }

  TEST_F(Report, BadInputIsOneSentenceAndLeavesNothing)
  {
    const fs::path output         = folder.path / "page";
    const auto     expect_refusal = [&](const fs::path &input, const std::vector<std::string> &parts) {
      expect_failure(report(input, {"--output", output}), 2, parts);
      EXPECT_FALSE(fs::exists(output));
    };
    expect_refusal(folder.path / "absent", {"absent", "--output of an earlier command"});
    expect_refusal(run_folder / "summary.json", {"summary.json", "--output of an earlier command"});
    fs::create_directory(folder.path / "empty");
    expect_refusal(folder.path / "empty", {"empty holds no results"});
    folder.write("empty/displacement_frequency.csv", "frequency_Hz\n1\n");
    expect_refusal(folder.path / "empty", {"displacement_frequency.csv:1", "young_modulus_Pa"});
    folder.write("run/snapshots.h5", "cut");
    expect_refusal(run_folder, {"snapshots.h5"});
    folder.write("run/trajectory.csv", "time_s\nx\n");
    expect_refusal(run_folder, {"trajectory.csv"});
    folder.write("run/summary.json", "{");
    expect_refusal(run_folder, {"summary.json"});
  }

  // Tests may run as root, whom no permission stops: a file in the folder's place does.
  TEST_F(Report, OutputThatCannotBeMadeIsRefused)
  {
    const auto file = folder.write("page", "mine");
    expect_failure(report(run_folder, {"--output", file}), 2, {file.string(), "choose another --output"});
    EXPECT_EQ(content(file), "mine");
  }
} // namespace swimtwin
