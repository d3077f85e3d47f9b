#include <datasets/calibration_result.h>
#include <datasets/csv_table.h>
#include <datasets/scene.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    Outcome tool(const std::vector<std::string> &arguments)
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
        return tool(arguments);
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
    const Outcome outcome = calibrate({"--data", SWIMTWIN_SOURCE_DIR "/datasets/observations/synthetic-soft.csv"});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    expect_in(outcome.output, "status       converged");
    const CalibrationResult result = read_calibration_result(folder.path / "results/calibration.json");
    EXPECT_EQ(result.discrepancy.origin, "held-out runs");
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
  }

  TEST_F(CalibrateVerb, RefusesBadObservationsAndLeavesNothing)
  {
    expect_refusal("frequency_Hz,displacement_m\n0.2,1e-4\n0.5,1e-4\n", "sigma_m");
    expect_refusal("frequency_Hz,displacement_m,sigma_m\n0.2,nan,2e-6\n0.5,1e-4,2e-6\n", "displacement_m");
    expect_refusal("frequency_Hz,displacement_m,sigma_m\n0.2,1e-4,0\n0.5,1e-4,2e-6\n", "sigma_m");
    expect_refusal("frequency_Hz,displacement_m,sigma_m\n0.2,1e-4,-1e-6\n0.5,1e-4,2e-6\n", "sigma_m");
    expect_refusal("frequency_Hz,displacement_m,sigma_m\n0.2,1e-4,1e-6\n0.2,1e-4,2e-6\n", "frequency_Hz");
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

  TEST_F(CalibrateVerb, SaysThatThisBuildCannotVerify)
  {
    const Outcome outcome = calibrate({"--data", folder.write("curve.csv", table), "--verify", "2"});
    EXPECT_EQ(outcome.code, 2);
    expect_in(outcome.errors, "--verify needs the full-order model, which this build is without");
  }
} // namespace swimtwin
