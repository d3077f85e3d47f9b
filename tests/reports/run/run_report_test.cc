#include <reports/run/run_report.h>

#include <datasets/system/error.h>
#include <reports/page/shown_units.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/reports/synthetic_run.h>
#include <tests/reports/tag_balance.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    class RunReport : public ::testing::Test
    {
    protected:
      RunReport()
      {
        scene                            = synthetic_scene();
        summary.status                   = "completed";
        summary.n_unknowns               = 8207;
        summary.n_steps                  = 303;
        summary.n_linear_solves          = 331;
        summary.n_factorizations         = 110;
        summary.coupling_iterations_mean = 1.0924;
        summary.n_remeshes               = 7;
        summary.n_step_halvings          = 2;
        summary.wall_time_s              = 12.345;
        summary.cpu_time_s               = 10.;
        summary.peak_memory_MB           = 231.5;
        summary.cpu_time_of_part_s       = {{"factorization", 4.}, {"krylov_solve", 3.5}};
        summarize_motion(trajectory, scene.field.period_s(), 0., summary);
        provenance = {"swimtwin 1.2.3", "swimtwin simulate <scene>", scene.text,
                      scene.hash,       "2025-01-31T12:00:00Z",      12.345};
      }

      void write() const
      {
        write_run_summary_json(folder.path / "summary.json", {summary, provenance});
        write_trajectory_csv(folder.path / "trajectory.csv", trajectory);
      }

      /// Of the files of the run.
      std::string page() const
      {
        write();
        const std::string text = run_page(read_run(folder.path), {}).text();
        EXPECT_EQ(first_unbalanced_tag(text), "");
        return text;
      }

      static void expect_number(const std::string &page, const std::string &row, const double value,
                                const double tolerance = 1e-3)
      {
        const auto cells = cells_of(page, row);
        ASSERT_FALSE(cells.empty()) << row;
        EXPECT_NEAR(number_in(cells.front()), value, tolerance * std::abs(value)) << row;
      }

      const TemporaryFolder folder;
      Scene                 scene;
      Trajectory            trajectory = synthetic_trajectory(synthetic_scene().field.period_s(), 300, 100, 0.002);
      RunSummary            summary;
      Provenance            provenance;
    };
  } // namespace

  TEST_F(RunReport, EveryNumberIsThatOfTheSummary)
  {
    const std::string text = page();
    ASSERT_EQ(summary.displacement_per_period_m.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
      expect_number(text, std::to_string(k + 1), 1e3 * summary.displacement_per_period_m[k], 1e-5);
    expect_number(text, "unknowns", summary.n_unknowns, 0.);
    expect_number(text, "steps", summary.n_steps, 0.);
    expect_number(text, "linear solves", summary.n_linear_solves, 0.);
    expect_number(text, "factorisations", summary.n_factorizations, 0.);
    expect_number(text, "coupling iterations per step", summary.coupling_iterations_mean.value());
    expect_number(text, "remeshings", summary.n_remeshes, 0.);
    expect_number(text, "halved steps", summary.n_step_halvings, 0.);
    expect_number(text, "wall time (s)", summary.wall_time_s);
    expect_number(text, "CPU time (s)", summary.cpu_time_s);
    expect_number(text, "peak memory (MB)", summary.peak_memory_MB);
    expect_number(text, "imbalance of the last full period (%)", 100 * summary.power_imbalance.value());
    expect_number(text, "imbalance of the worst period (%)", 100 * summary.worst_power_imbalance.value());
  }

  TEST_F(RunReport, PartsOfTheCpuTimeAddUpToAllOfIt)
  {
    const std::string text    = page();
    double            percent = 0., seconds = 0.;
    for (const char *part : {"factorization", "krylov solve", "all else"})
    {
      const auto cells = cells_of(text, part);
      ASSERT_EQ(cells.size(), 2u) << part;
      seconds += number_in(cells[0]);
      percent += number_in(cells[1]);
    }
    EXPECT_NEAR(seconds, summary.cpu_time_s, 1e-5);
    EXPECT_NEAR(percent, 100., 0.15); // rounded to 0.1
    EXPECT_EQ(cells_of(text, "factorization")[1], "40.0");
  }

  TEST_F(RunReport, WorksOfTheLastPeriodLeaveTheImbalanceOfTheSummary)
  {
    const std::string text = page();
    const auto        work = [&](const char *row) { return number_in(cells_of(text, row).at(0)); };
    const double      missing =
        work("magnetic work") - work("viscous dissipation") - work("gain of elastic and kinetic energy");
    EXPECT_NEAR(missing, work("missing"), 1e-5 * work("magnetic work"));
    EXPECT_NEAR(number_in(cells_of(text, "missing").at(1)), 100 * summary.power_imbalance.value(), 1e-3);
  }

  TEST_F(RunReport, VerdictSaysWhatTheUserWantsToKnow)
  {
    const std::string text = page();
    expect_in(text, "class=\"verdict good\"");
    expect_in(text, "completed; +0.17 mm (+0.02125 body lengths) in period 3, positive head first");
    expect_in(text, "power imbalance −0.2 %");
  }

  TEST_F(RunReport, ProvenanceAndSceneAreThere)
  {
    const std::string text = page();
    expect_in(text, "swimtwin simulate &lt;scene&gt;");
    expect_in(text, provenance.scene_hash);
    expect_in(text, provenance.created);
    expect_in(text, provenance.program_version);
    expect_in(text, "<pre>" + escaped(provenance.scene_text) + "</pre>");
  }

  TEST_F(RunReport, FailedRunSaysSoWithItsCauseAndShowsNoEarlierTrajectory)
  {
    summary.status                    = "failed: the step <5> did not converge";
    summary.displacement_per_period_m = {};
    const std::string text            = page();
    expect_in(text, "<p class=\"verdict bad\">failed: the step &lt;5&gt; did not converge");
    EXPECT_TRUE(cells_of(text, "magnetic work").empty());
    EXPECT_TRUE(cells_of(text, "imbalance of the last full period (%)").empty()); // 0 would look like a closed balance
    expect_number(text, "steps", summary.n_steps, 0.);
  }

  TEST_F(RunReport, NumbersThatAreNotFiniteAreNamedSo)
  {
    summary.power_imbalance = std::numeric_limits<double>::quiet_NaN();
    const std::string text  = page();
    expect_in(text, "class=\"verdict bad\"");
    expect_in(text, "power_imbalance not finite");
    EXPECT_EQ(cells_of(text, "imbalance of the last full period (%)"), std::vector<std::string>{"not finite"});
  }

  TEST_F(RunReport, ShortRunHasWordsWhereAnImbalanceWouldBe)
  {
    trajectory.resize(50);
    summarize_motion(trajectory, scene.field.period_s(), 0., summary);
    const std::string text = page();
    expect_in(text, "completed; no full period was computed");
    EXPECT_EQ(text.find("0 %"), std::string::npos);
    EXPECT_TRUE(cells_of(text, "imbalance of the last full period (%)").empty());
  }

  TEST_F(RunReport, WithoutWorkThePageSaysWhyThereIsNoImbalance)
  {
    for (TrajectoryRow &row : trajectory)
      row.magnetic_power_W_m = row.dissipation_W_m = 0.;
    summarize_motion(trajectory, scene.field.period_s(), 0., summary);
    EXPECT_EQ(cells_of(page(), "imbalance of the last full period (%)"),
              std::vector<std::string>{"no magnetic work and no dissipation to compare with"});
    expect_in(page(), "no power imbalance: no magnetic work");
  }

  TEST_F(RunReport, WorksAreThoseOfTheSummary)
  {
    summary.work_of_last_period = WorkBalance{3e-6, 0., 1e-6, 2e-6};
    EXPECT_EQ(cells_of(page(), "magnetic work").at(0), "3");
    EXPECT_EQ(cells_of(page(), "gain of elastic and kinetic energy").at(0), "2");
  }

  TEST_F(RunReport, SceneThatCannotBeReadLeavesThePageWithAWarning)
  {
    provenance.scene_text  = "dimension = 2\nfrom_the_future = 1\n";
    const std::string text = page();
    expect_in(text, "class=\"warning\"");
    expect_in(text, "from_the_future");
    expect_number(text, "unknowns", summary.n_unknowns, 0.);
  }

  TEST_F(RunReport, MissingTrajectoryIsAWarning)
  {
    write();
    std::filesystem::remove(folder.path / "trajectory.csv");
    expect_in(run_page(read_run(folder.path), {}).text(), "trajectory.csv is missing");
  }

  TEST_F(RunReport, EverySceneHasAPage)
  {
    for (const std::string &toml : {swimmer_toml, beam_toml})
    {
      provenance.scene_text = toml;
      EXPECT_EQ(page().find("class=\"warning\""), std::string::npos);
    }
  }

  TEST_F(RunReport, BadFilesAreNamed)
  {
    write();
    const auto message = [&] { return message_of<InputError>([&] { read_run(folder.path); }); };
    folder.write("trajectory.csv", "time_s,head_x_m\n1\n");
    expect_in(message(), (folder.path / "trajectory.csv").string() + ":2");
    folder.write("summary.json", "{");
    expect_in(message(), (folder.path / "summary.json").string());
  }

  TEST(RunFolder, IsNamedAfterItsLastPart)
  {
    EXPECT_EQ(folder_name("/runs/soft"), "soft");
    EXPECT_EQ(folder_name("/runs/soft/"), "soft");
    EXPECT_EQ(folder_name("/runs/stiff/../soft/."), "soft");
    EXPECT_EQ(folder_name("."), std::filesystem::current_path().filename());
  }
} // namespace swimtwin
