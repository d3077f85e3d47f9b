#include <datasets/observation/calibration_result.h>

#include <datasets/files/json_entries.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    CalibrationResult example_result()
    {
      CalibrationResult result;
      result.status                   = "converged";
      result.swimmer.young_modulus_Pa = 1. / 3.;
      CalibratedParameter free;
      free.name           = "young_modulus_Pa";
      free.role           = ParameterRole::free;
      free.standard_error = 0.1;
      free.curvature      = {"curvature", 0.2, std::nullopt, "open above"};
      result.parameters   = {free};
      result.covariance   = Eigen::Matrix2d{{1., NAN}, {NAN, 4.}};
      result.bootstrap    = Eigen::MatrixXd::Random(5, 2);
      result.null_directions.push_back({Eigen::Vector2d(0.6, 0.8), 1e-9, false, "go together"});
      result.starts.push_back({Eigen::Vector2d(1., 2.), Eigen::Vector2d(3., 4.), 5., 6., "converged", 1e-6, 9});
      result.posterior.resize(3);
      result.next.emplace().frequency_Hz = {1., 2.};
      result.warnings                    = {"a \"quoted\" warning"};
      return result;
    }
  } // namespace

  TEST(CalibrationResult, ComesBackAsItWasWritten)
  {
    const TemporaryFolder   folder;
    const CalibrationResult written = example_result();
    write_calibration_result(folder.path / "calibration.json", written);
    const CalibrationResult read = read_calibration_result(folder.path / "calibration.json");
    EXPECT_EQ(read.swimmer.young_modulus_Pa, written.swimmer.young_modulus_Pa);
    EXPECT_EQ(read.parameters[0].role, ParameterRole::free);
    EXPECT_EQ(read.parameters[0].standard_error, 0.1);
    EXPECT_FALSE(read.parameters[0].prior_mean);
    EXPECT_EQ(read.parameters[0].interval().note, "open above");
    EXPECT_FALSE(read.parameters[0].interval().is_finite());
    EXPECT_TRUE(std::isnan(read.covariance(0, 1)));
    EXPECT_EQ(read.covariance(1, 1), 4.);
    EXPECT_EQ(read.bootstrap, written.bootstrap);
    EXPECT_EQ(read.null_directions[0].direction, Eigen::VectorXd(Eigen::Vector2d(0.6, 0.8)));
    EXPECT_EQ(read.starts[0].end[1], 4.);
    EXPECT_EQ(read.posterior.size(), 3u);
    EXPECT_EQ(read.next->frequency_Hz[1], 2.);
    EXPECT_EQ(read.warnings, written.warnings);
    EXPECT_EQ(read.free_names(), std::vector<std::string>{"young_modulus_Pa"});
    EXPECT_EQ(read.find("viscosity_Pa_s"), nullptr);
    EXPECT_TRUE(read.converged());
  }

  TEST(CalibrationResult, OfAnEarlierVersionWasNotRefined)
  {
    const TemporaryFolder folder;
    write_calibration_result(folder.path / "calibration.json", example_result());
    Json json = read_json_file(folder.path / "calibration.json", "the result", "");
    json.erase("refinement");
    write_json_file(folder.path / "calibration.json", json);
    EXPECT_TRUE(read_calibration_result(folder.path / "calibration.json").refinement.empty());
  }

  TEST(CalibrationResult, MeasuresBothModelsByWhatIsNotNearAZero)
  {
    ModelDiscrepancy discrepancy;
    discrepancy.checks = {{"a", 1., 1.01e-4, 1e-4}, {"a", 2., 3e-7, 1e-7}};
    EXPECT_NEAR(discrepancy.largest_difference(), 2e-7 / 5e-6, 1e-12);
    discrepancy.checks.pop_back();
    EXPECT_NEAR(discrepancy.largest_difference(), .01, 1e-12);
  }

  TEST(CalibrationResult, RefusesWhatIsNotOne)
  {
    const TemporaryFolder folder;
    const auto            refusal = [&](const std::string &text) {
      try
      {
        read_calibration_result(folder.write("calibration.json", text));
      }
      catch (const InputError &error)
      {
        return std::string(error.what());
      }
      return std::string("accepted");
    };
    EXPECT_NE(refusal("{\"status\": ").find("was cut short: it ends in the middle"), std::string::npos);
    EXPECT_NE(refusal("{}").find("lacks the entry status"), std::string::npos);
    EXPECT_NE(refusal("[1]").find("lacks the entry status"), std::string::npos);
    EXPECT_NE(refusal("{\"status\": 3}").find("has an entry status of the wrong kind"), std::string::npos);
    write_calibration_result(folder.path / "roles.json", example_result());
    std::string text = content(folder.path / "roles.json");
    EXPECT_NE(refusal(text.replace(text.find("\"free\""), 6, "\"guessed\"")).find("unknown role guessed"),
              std::string::npos);
    EXPECT_THROW(read_calibration_result(folder.path / "none.json"), InputError);
  }
} // namespace swimtwin
