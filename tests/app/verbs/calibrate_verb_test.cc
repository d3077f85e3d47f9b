#include <app/frame/written_files.h>
#include <datasets/observation/calibration_result.h>
#include <datasets/scene/scene.h>
#include <datasets/text/csv_table.h>
#include <tests/app/declared_files.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace swimtwin
{
  namespace
  {
    Outcome calibrate_tool(const std::vector<std::string> &arguments)
    {
      return run_in_process(arguments, {{"calibrate", add_calibrate}});
    }

    const std::string problem = R"(
[parameters.young_modulus_over_viscosity_1_s]
bounds = [3.5e4, 8e4]
[parameters.magnetization_over_viscosity_A_m_Pa_s]
bounds = [1e5, 1.7e5]
[fit]
starts = 6
[uncertainty]
bootstrap_samples = 60
)";
    const std::string sidecar = "source = \"none\"\nsynthetic = true\nswimmer = \"none\"\nmeasured_by = \"none\"\n"
                                "period = 3\n[field]\nbx_T = 5e-3\nby_T = 5e-3\n";
    const std::string table = "frequency_Hz,displacement_m,sigma_m\n0.2,1.14e-4,2e-6\n0.5,1.8e-4,3e-6\n1,1.7e-4,3e-6\n";

    class CalibrateVerb : public ::testing::Test
    {
    protected:
      CalibrateVerb()
      {
        folder.write("fit.toml", problem);
        folder.write("curve.toml", sidecar);
      }

      Outcome calibrate(const std::vector<std::string> &options) const
      {
        std::vector<std::string> arguments = {"calibrate", "reference-2d", folder.path / "fit.toml", "--output",
                                              results};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return calibrate_tool(arguments);
      }

      /// Of a table with these rows; nothing may be left under its final name.
      void expect_refusal(const std::string &text, const std::string &part) const
      {
        const Outcome outcome = calibrate({"--data", folder.write("curve.csv", text)});
        EXPECT_EQ(outcome.code, 2);
        expect_in(outcome.errors, part);
        EXPECT_FALSE(std::filesystem::exists(folder.path / "results/calibration.json"));
        EXPECT_FALSE(std::filesystem::exists(folder.path / "results/fitted-scene.toml"));
      }

      const TemporaryFolder folder;
      const std::string     results = folder.path / "results";
    };
  } // namespace

  TEST_F(CalibrateVerb, FindsTheFullOrderSwimmerOfTheShippedData)
  {
    const Outcome outcome =
        calibrate({"--data", std::string(places::source) + "/datasets/observations/synthetic-soft.csv"});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    expect_in(outcome.output, "status       converged");
    const CalibrationResult result = read_calibration_result(folder.path / "results/calibration.json");
    EXPECT_EQ(result.discrepancy.origin, "held-out runs");
    EXPECT_TRUE(result.inertia.empty());             // the sidecar says that the data have none
    const double truth[] = {8e4 / 1.52, 2e5 / 1.52}; // of the full-order run with 2 % noise
    for (int j = 0; j < 2; ++j)
    {
      const CalibratedParameter &p = result.parameters[static_cast<std::size_t>(j)];
      EXPECT_NEAR(p.value, truth[j], 0.05 * truth[j]);
    }
    EXPECT_LE(*result.parameters[0].profile.low, truth[0]);
    EXPECT_GE(*result.parameters[0].profile.high, truth[0]);
    EXPECT_EQ(result.residuals.size(), 12u);
    EXPECT_FALSE(result.provenance.scene_hash.empty());

    const Scene scene = read_scene(folder.path / "results/fitted-scene.toml"); // ready for simulate
    EXPECT_NEAR(scene.tail->young_modulus_Pa / scene.fluid->viscosity_Pa_s, result.parameters[0].value,
                1e-6 * truth[0]);
    EXPECT_EQ(scene.head.magnetization_A_m, result.swimmer.magnetization_A_m);
    EXPECT_EQ(CsvTable::read(folder.path / "results/residuals.csv").n_rows(), 12u);
    EXPECT_EQ(CsvTable::read(folder.path / "results/starts.csv").n_rows(), 6u);
    EXPECT_EQ(CsvTable::read(folder.path / "results/band.csv").n_rows(), 61u);
    for (const char *name : {"parameters.csv", "profiles.csv", "posterior.csv", "next_experiment.csv"})
      EXPECT_GT(CsvTable::read(folder.path / "results" / name).n_rows(), 5u) << name;
    expect_all_declared(results, written_by::calibrate().patterns);
  }

  // One observation is ten times too large.
  TEST_F(CalibrateVerb, FindsTheMinimumBesideAnOutlierAndNamesTheLossThatItCannotPull)
  {
    const std::string data    = std::string(places::source) + "/tests/datasets/cases/curves/outlier.csv";
    const Outcome     outcome = calibrate({"--data", data, "--inertia", "none"});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    expect_in(outcome.output, "status       converged");
    expect_in(outcome.errors, "outlier.csv:7: the observation at 0.72 Hz");
    expect_in(outcome.errors, "kind = \"huber\"");

    folder.write("fit.toml", problem + "[loss]\nkind = \"huber\"\n");
    const Outcome robust = calibrate({"--data", data, "--inertia", "none", "--force"});
    ASSERT_EQ(robust.code, 0) << robust.errors;
    const CalibrationResult result = read_calibration_result(folder.path / "results/calibration.json");
    EXPECT_NEAR(result.parameters[0].value, 8e4 / 1.52, 0.05 * 8e4 / 1.52);
    EXPECT_NEAR(result.parameters[1].value, 2e5 / 1.52, 0.05 * 2e5 / 1.52);
  }

  TEST_F(CalibrateVerb, RefusesBadObservationsAndLeavesNothing)
  {
    expect_refusal("frequency_Hz,displacement_m\n0.2,1e-4\n0.5,1e-4\n", "sigma_m");
    expect_refusal("frequency_Hz,displacement_m,sigma_m\n0.2,nan,2e-6\n0.5,1e-4,2e-6\n", "displacement_m");
    expect_refusal("frequency_Hz,displacement_m,sigma_m\n0.2,1e-4,0\n0.5,1e-4,2e-6\n", "sigma_m");
    expect_refusal("frequency_Hz,displacement_m,sigma_m\n0.2,1e-4,-1e-6\n0.5,1e-4,2e-6\n", "sigma_m");
    expect_refusal("frequency_Hz,displacement_m,sigma_m\n0.2,1e-4,1e-6\n-0.2,1e-4,2e-6\n", "frequency_Hz");
  }

  TEST_F(CalibrateVerb, RefusesProblemsThatCannotBeFitted)
  {
    folder.write("fit.toml", problem + "[parameters.displacement_scale]\nbounds = [0.5, 2]\n"
                                       "[parameters.displacement_offset_m]\nbounds = [-1e-5, 1e-5]\n");
    expect_refusal(table, "3 observations cannot fit 4 parameters");
    folder.write("fit.toml", "[parameters.young_modulus_Pa]\nbounds = [10, 100]\n");
    expect_refusal(table, "the bounds exclude every start");
    folder.write("fit.toml", "[parameters.young_modulus]\nbounds = [10, 100]\n");
    expect_refusal(table, "the nearest known name is young_modulus_Pa");
    const Outcome without_data = calibrate({});
    EXPECT_EQ(without_data.code, 2);
    folder.write("fit.toml", problem);
    expect_in(calibrate({}).errors, "give at least one CSV");
  }

  TEST_F(CalibrateVerb, ChecksProblemAndDataWithoutAFit)
  {
    folder.write("curve.csv", table);
    const std::vector<std::string> check = {
        "calibrate", "reference-2d", folder.path / "fit.toml", "--data", folder.path / "curve.csv", "--check"};
    const Outcome outcome = calibrate_tool(check);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    expect_in(outcome.output, "young_modulus_over_viscosity_1_s       3.5e+04 to 8e+04");
    expect_in(outcome.output, "curve\n    3 observations at 0.2 to 1 Hz, of period 3 after a start from rest\n");
    expect_in(outcome.output, "displacement   0.114 to 0.18 mm per period, ");
    expect_in(outcome.output, " to 0.0225 body lengths of 8 mm\n");
    expect_in(outcome.output, "sigma          0.002 to 0.003 mm, 1.67 to 1.76 % of the displacement\n");
    expect_in(outcome.output, "field          bx 5 mT, by 5 mT sin\n");
    expect_in(outcome.output, "nothing forbids a fit; warnings: 0");
    EXPECT_FALSE(std::filesystem::exists(folder.path / "results"));
  }

  TEST_F(CalibrateVerb, CarriesInertiaThatTheModelHas)
  {
    folder.write("curve.csv", table);
    const auto check = [&](const std::string &model, const std::string &inertia) {
      return calibrate_tool({"calibrate", model, folder.path / "fit.toml", "--data", folder.path / "curve.csv",
                             "--check", "--inertia", inertia});
    };
    const std::string without = std::string(places::source) + "/tests/models/reference-2d-version-1.h5";
    EXPECT_EQ(check("reference-2d", "full").code, 0);
    EXPECT_EQ(check(without, "auto").code, 0);
    const Outcome refused = check(without, "full");
    EXPECT_EQ(refused.code, 2);
    expect_in(refused.errors, "was trained without inertia; train it again with [fluid] inertia");
    EXPECT_EQ(check("reference-2d", "some").code, 2);
  }

  TEST_F(CalibrateVerb, RefusesToMixDataWithAndWithoutInertia)
  {
    folder.write("curve.csv", table);
    folder.write("computed.csv", table);
    std::string text = sidecar;
    text.insert(text.find("[field]"), "[fluid]\ninertia = \"none\"\n");
    folder.write("computed.toml", text);
    const Outcome outcome = calibrate_tool({"calibrate", "reference-2d", folder.path / "fit.toml", "--check", "--data",
                                            folder.path / "curve.csv", folder.path / "computed.csv"});
    EXPECT_EQ(outcome.code, 2);
    expect_in(outcome.errors, "computed was computed without inertia");
    expect_in(outcome.errors, "choose with --inertia");
  }

  TEST_F(CalibrateVerb, RefusesDataOfAnotherDimensionThanTheModels)
  {
    for (const auto &[model, data] :
         {std::pair{"reference-3d", "synthetic-soft"}, std::pair{"reference-2d", "synthetic-spatial"}})
    {
      const Outcome outcome = calibrate_tool({"calibrate", model, folder.path / "fit.toml", "--check", "--data",
                                              fmt::format("{}/datasets/observations/{}.csv", places::source, data)});
      EXPECT_EQ(outcome.code, 2);
      expect_in(outcome.errors, "take a model of the data's dimension");
    }
  }

  TEST_F(CalibrateVerb, WarnsOfABodyOfAnotherLength)
  {
    const std::string data   = folder.write("curve.csv", table);
    const auto        errors = [&](const std::string &length) {
      folder.write("curve.toml", length + sidecar);
      return calibrate_tool({"calibrate", "reference-2d", folder.path / "fit.toml", "--check", "--data", data}).errors;
    };
    EXPECT_EQ(errors("body_length_m = 0.0081\n"), "");
    expect_in(errors("body_length_m = 0.004\n"), "curve: of a body 4 mm long, as its sidecar says, and the model's is");
  }

  TEST_F(CalibrateVerb, CheckFindsWhatAFitWouldFind)
  {
    const auto check = [&](const std::string &text) {
      return calibrate_tool({"calibrate", "reference-2d", folder.path / "fit.toml", "--check", "--data",
                             folder.write("curve.csv", text), "--data", folder.path / "other.csv"});
    };
    folder.write("other.toml", sidecar);
    folder.write("other.csv", "frequency_Hz,displacement_m,sigma_m\n0.2,1e-4,-1\n0.5,1e-4,2e-6\n");
    const Outcome both = check("frequency_Hz,displacement_m,sigma_m\n0.2,1.14e-4,0\n0.5,1.8e-4,3e-6\n");
    EXPECT_EQ(both.code, 2); // the errors of all files at once
    expect_in(both.errors, "curve.csv:2");
    expect_in(both.errors, "other.csv:2");
    folder.write("other.csv", table);
    const Outcome in_mm = check("frequency_Hz,displacement_m,sigma_m\n0.2,0.114,2e-3\n0.5,0.18,3e-3\n");
    EXPECT_EQ(in_mm.code, 0);
    expect_in(in_mm.errors, "swimtwin: warning:");
    expect_in(in_mm.errors, "looks like mm in a column of metres");
    folder.write("fit.toml", "[parameters.young_modulus_Pa]\nbounds = [10, 100]\n");
    const Outcome in_kPa = check(table);
    EXPECT_EQ(in_kPa.code, 2);
    expect_in(in_kPa.errors, "the bounds exclude every start");
  }

  TEST_F(CalibrateVerb, NeedsAFolderForAFit)
  {
    const Outcome outcome = calibrate_tool(
        {"calibrate", "reference-2d", folder.path / "fit.toml", "--data", folder.write("curve.csv", table)});
    EXPECT_EQ(outcome.code, 2);
    expect_in(outcome.errors, "--output is required");
  }

  TEST_F(CalibrateVerb, SaysThatThisBuildCannotVerify)
  {
    const Outcome outcome = calibrate({"--data", folder.write("curve.csv", table), "--verify", "2"});
    EXPECT_EQ(outcome.code, 2);
    expect_in(outcome.errors, "--verify needs the full-order model, which this build is without");
  }
} // namespace swimtwin
