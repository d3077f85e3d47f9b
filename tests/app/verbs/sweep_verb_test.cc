#include <app/frame/tool.h>
#include <datasets/files/hdf5_file.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <datasets/text/csv_table.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/rom/example_model.h>

#include <nlohmann/json.hpp>

namespace swimtwin
{
  namespace
  {
    Outcome sweep_tool(const std::vector<std::string> &arguments)
    {
      return run_in_process(arguments, {{"sweep", add_sweep}, {"report", add_report}});
    }

    class SweepVerb : public ::testing::Test
    {
    protected:
      SweepVerb() { write_reduced_model(model, example_model({.magnetic_tail = false}), Provenance{}); }

      Outcome sweep(const std::vector<std::string> &options) const
      {
        std::vector<std::string> arguments = {"sweep", model, "--output", results};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return sweep_tool(arguments);
      }

      const TemporaryFolder folder;
      const std::string     model = folder.path / "model.h5", results = folder.path / "results";
    };

    void expect_refusal(const Outcome &outcome, const std::string &part)
    {
      EXPECT_EQ(outcome.code, 2);
      expect_in(outcome.errors, part);
    }
  } // namespace

  TEST_F(SweepVerb, WritesTableDataAndSummary)
  {
    const Outcome outcome = sweep({"--frequency", "0.2:2:4", "--young-modulus", "5e4,2e5"});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    const CsvTable table = CsvTable::read(folder.path / "results/displacement_frequency.csv");
    EXPECT_EQ(table.n_rows(), 8u);
    EXPECT_EQ(table.column_names()[0], "young_modulus_Pa");
    EXPECT_EQ(table.column_names()[1], "frequency_Hz");
    EXPECT_EQ(table.column_names()[2], "displacement_m");
    EXPECT_EQ(table.column("frequency_Hz")[3], 2.);
    EXPECT_EQ(table.column("young_modulus_Pa")[4], 2e5);
    EXPECT_EQ(table.column("inside_trained_range"), std::vector<double>(8, 1.));
    const Hdf5Reader data(folder.path / "results/sweep.h5");
    EXPECT_EQ(data.read_vector("/displacement_m"), table.column("displacement_m"));
    EXPECT_EQ(data.read_text_attribute("/displacement_m", "units"), "m");
    const auto json = nlohmann::json::parse(content(folder.path / "results/sweep.json"));
    EXPECT_EQ(json["status"], "completed");
    EXPECT_EQ(json["n_members"], 8);
    EXPECT_EQ(json["peaks"].size(), 2u);
    EXPECT_EQ(json["model"]["neglects"].size(), 2u);
    EXPECT_FALSE(json["provenance"]["scene_hash"].get<std::string>().empty());
  }

  TEST_F(SweepVerb, PrintsWhatTheModelSaysAboutItselfAndThePeaks)
  {
    const Outcome outcome = sweep({"--frequency", "0.2:2:4"});
    expect_in(outcome.output, "trained at   E 4e+04 to 3e+05 Pa");
    expect_in(outcome.output, "in 1 full-order runs not trained on");
    expect_in(outcome.output, "neglects     Inertia of fluid and solid");
    expect_in(outcome.output, "E = 100000 Pa");
    EXPECT_TRUE(sweep({"--frequency", "1", "--force", "--quiet"}).output.empty());
  }

  TEST_F(SweepVerb, WithoutOptionsRunsTheModelsOwnScene)
  {
    ASSERT_EQ(sweep({"--quiet"}).code, 0);
    const CsvTable table = CsvTable::read(folder.path / "results/displacement_frequency.csv");
    EXPECT_EQ(table.n_rows(), 1u);
    EXPECT_NEAR(table.column("frequency_Hz")[0], 0.8, 1e-15);
    EXPECT_EQ(table.column("young_modulus_Pa")[0], 1e5);
  }

  TEST_F(SweepVerb, ReportTakesItsFolder)
  {
    ASSERT_EQ(sweep({"--frequency", "0.2:2:4", "--viscosity", "1.4,1.52", "--quiet"}).code, 0);
    const Outcome report = sweep_tool({"report", results});
    EXPECT_EQ(report.code, 0) << report.errors;
    expect_in(content(folder.path / "results/report.html"), "1.52 Pa s");
  }

  TEST_F(SweepVerb, MarksAndCountsRowsOutsideTheTrainedRange)
  {
    const Outcome outcome = sweep({"--young-modulus", "1e4,1e5,1e6", "--quiet"});
    EXPECT_EQ(outcome.code, 0);
    expect_in(outcome.errors, "warning: 2 of 3 rows are outside what the model was trained for");
    const CsvTable table = CsvTable::read(folder.path / "results/displacement_frequency.csv");
    EXPECT_EQ(table.column("inside_trained_range"), (std::vector<double>{0., 1., 0.}));
    expect_in(table.cells(0).back(), "young_modulus_Pa = 1e+04 below 4e+04");
    EXPECT_EQ(table.cells(1).back(), "ok");
  }

  TEST_F(SweepVerb, SaysThatItsModelMissedItsTargetAndMarksTheRows)
  {
    ReducedModel off                                   = example_model({.magnetic_tail = false});
    off.record.held_out_runs[0].reduced_displacement_m = 1.25 * off.record.held_out_runs[0].displacement_m;
    write_reduced_model(folder.path / "off.h5", off, Provenance{});
    const Outcome outcome = sweep_tool({"sweep", (folder.path / "off.h5").string(), "--frequency", "0.8,1", "--output",
                                        (folder.path / "swept").string(), "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    expect_in(outcome.errors, "off.h5: the reduced model misses its target: displacements are off by 25 % (rms)");
    const CsvTable table = CsvTable::read(folder.path / "swept/displacement_frequency.csv");
    expect_in(table.cells(0).back(), "held-out runs nearby are off by 25 %; the error may be"); // and by how much
    EXPECT_NEAR(table.column("held_out_error")[1], 0.25, 1e-12);
  }

  TEST_F(SweepVerb, WarnsOfRowsThatWereNotComputed)
  {
    const Outcome outcome = sweep({"--magnetization", "1e5,1e300", "--quiet"});
    EXPECT_EQ(outcome.code, 0);
    expect_in(outcome.errors, "warning: 1 of 2 rows were not computed; the column note says why");
    const CsvTable table = CsvTable::read(folder.path / "results/displacement_frequency.csv");
    ASSERT_EQ(table.n_rows(), 2u);
    EXPECT_EQ(table.cells(1)[2], "");
    EXPECT_EQ(table.cells(1).end()[-2], "failed");
    expect_in(table.cells(1).back(), "a rate is not finite");
    const auto json = nlohmann::json::parse(content(folder.path / "results/sweep.json"));
    EXPECT_EQ(json["not_computed"].at(0)["magnetization_A_m"], 1e300);
    EXPECT_EQ(sweep_tool({"report", results, "--quiet"}).code, 0);
    expect_in(content(folder.path / "results/report.html"), "1 of 2 rows were not computed");
  }

  TEST_F(SweepVerb, RefusesWhereInertiaIsNotSmall)
  {
    expect_refusal(sweep({"--frequency", "1:12:3"}), "the unsteady group 2 pi rho f L^2 / mu is 4");
    const Outcome allowed = sweep({"--frequency", "1:12:3", "--allow-inertia", "--quiet"});
    EXPECT_EQ(allowed.code, 0);
    expect_in(allowed.errors, "warning: at 12 Hz");
    expect_in(sweep({"--frequency", "4", "--quiet", "--force"}).errors, "neglects inertia");
  }

  TEST_F(SweepVerb, RefusesInertiaOfAModelThatHasNone)
  {
    expect_refusal(sweep({"--inertia", "full"}), "was trained without inertia");
    EXPECT_EQ(sweep({"--inertia", "none", "--quiet"}).code, 0);
  }

  TEST_F(SweepVerb, TakesTheFolderOfATrainingThatHasEnded)
  {
    const auto training = folder.path / "training";
    std::filesystem::create_directories(training / "runs/run-01");
    const auto swept = [&](const std::filesystem::path &what) {
      return sweep_tool({"sweep", what, "--output", results, "--quiet"});
    };
    for (const auto &what : {training, training / "model.h5"})
      expect_refusal(swept(what), "the training in " + training.string() + " has not ended");
    const Outcome reported = sweep_tool({"report", training, "--quiet"});
    expect_refusal(reported, "is of a training");
    std::filesystem::copy(model, training / "model.h5");
    EXPECT_EQ(swept(training).code, 0);
    expect_in(sweep_tool({"report", training, "--quiet"}).errors, "model-card.txt");
  }

  TEST_F(SweepVerb, RefusesBadOptionsWithTheirNames)
  {
    expect_refusal(sweep({"--frequency", "3:0.1:60"}), "--frequency 3:0.1:60: the range");
    expect_refusal(sweep({"--frequency", ""}), "--frequency \"\": a value is missing");
    expect_refusal(sweep({"--young-modulus=-1"}), "--young-modulus -1: -1 is not positive");
    expect_refusal(sweep({"--viscosity", "thick"}), "--viscosity thick: \"thick\" is not a number");
    expect_refusal(sweep({"--modes", "9"}), "9 modes were asked of a reduced model that has 4");
    expect_refusal(sweep({"--modes=-1"}), "--modes -1 is not possible");
    EXPECT_FALSE(std::filesystem::exists(results));
  }

  TEST_F(SweepVerb, RefusesBadModels)
  {
    expect_refusal(sweep_tool({"sweep", "no-such-model", "--output", results}),
                   "no-such-model: No such file or directory");
    std::filesystem::resize_file(model, 1000);
    expect_refusal(sweep({}), "it was cut short: 1000 bytes are left");
  }

  TEST_F(SweepVerb, KeepsResultsUnlessForced)
  {
    ASSERT_EQ(sweep({"--quiet"}).code, 0);
    expect_refusal(sweep({"--quiet"}), "--force");
    EXPECT_EQ(sweep({"--quiet", "--force", "--modes", "2"}).code, 0);
  }
} // namespace swimtwin
