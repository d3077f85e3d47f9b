#include <reports/fit/calibration_report.h>

#include <tests/datasets/temporary_folder.h>
#include <tests/reports/synthetic_calibration.h>
#include <tests/reports/tag_balance.h>

namespace swimtwin
{
  namespace
  {
    std::string page_of(const CalibrationResult &result)
    {
      const std::string text = calibration_page(result, "a fit", {}).text();
      EXPECT_EQ(first_unbalanced_tag(text), "");
      return text;
    }
  } // namespace

  TEST(CalibrationReport, VerdictNamesEstimatesAndIntervals)
  {
    expect_in(page_of(synthetic_calibration()),
              "class=\"verdict good\">converged; E/μ (10³/s) = 52.63 (51.38 to 53.97)");
    CalibrationResult result = synthetic_calibration();
    result.status            = "undetermined";
    expect_in(page_of(result), "class=\"verdict bad\">undetermined");
  }

  TEST(CalibrationReport, ParametersStandWithTheirIntervals)
  {
    CalibrationResult result                      = synthetic_calibration();
    result.parameters[1].prior_mean               = 130000.;
    result.parameters[1].prior_standard_deviation = 5000.;
    const auto cells                              = cells_of(page_of(result), "M/μ (kA/(m Pa s))");
    EXPECT_EQ(cells, (std::vector<std::string>{"fitted", "131.6", "1.84", "127.9 to 135.5", "127.9 to 135.3",
                                               "128 to 135.2", "26.32 to 657.9", "130 ± 5"}));
  }

  TEST(CalibrationReport, ClaimsNothingForAnUndeterminedParameter)
  {
    CalibrationResult    result    = synthetic_calibration();
    CalibratedParameter &parameter = result.parameters[0];
    parameter.undetermined         = true;
    parameter.profile              = {"profile", std::nullopt, std::nullopt, "The misfit stays below the threshold."};
    parameter.bootstrap.note       = parameter.profile.note;
    parameter.curvature            = {};
    result.null_directions.push_back({Eigen::Vector3d(0.71, 0.71, 1e-6), 1e-9, false, "E, μ and M scale together."});
    const std::string text  = page_of(result);
    const auto        cells = cells_of(text, "E/μ (10³/s)");
    EXPECT_EQ(cells[0], "undetermined");
    EXPECT_EQ(cells[2], "–");
    EXPECT_EQ(cells[3], "not bounded");
    EXPECT_EQ(cells[4], "not bounded"); // though the bootstrap scatters between the bounds
    EXPECT_EQ(cells[5], "–");
    EXPECT_EQ(text.find("E/μ (10³/s) ="), std::string::npos);
    EXPECT_EQ(text.find("The misfit stays"), text.rfind("The misfit stays")); // once for both methods
    expect_in(text, "<p>E/μ: The misfit stays below the threshold.</p>");
    const auto null = cells_of(text, "E/μ +0.71, M/μ +0.71");
    ASSERT_EQ(null.size(), 3u);
    EXPECT_EQ(null[2], "E, μ and M scale together.");
  }

  TEST(CalibrationReport, GivenParametersStandWithTheSwimmerAlone)
  {
    CalibrationResult result = synthetic_calibration();
    result.parameters.push_back(synthetic_parameter("geometry_scale", 1., 0.1));
    result.parameters.back().role = ParameterRole::fixed;
    EXPECT_EQ(cells_of(page_of(result), "geometry scale"), std::vector<std::string>{"1"});
  }

  TEST(CalibrationReport, SaysWhenEverythingIsDetermined)
  {
    expect_in(page_of(synthetic_calibration()), "Every free parameter is determined by the data.");
  }

  TEST(CalibrationReport, ShowsObservationsChecksAndTheNextExperiment)
  {
    const std::string text = page_of(synthetic_calibration());
    expect_in(text, "Observations and residuals");
    const auto check = cells_of(text.substr(text.find("The reduced model")), "soft");
    EXPECT_EQ(check, (std::vector<std::string>{"0.58", "+0.186", "+0.187", "−0.535"}));
    expect_in(text, "Three full-order runs at the optimum leave the estimate where it is.");
    expect_in(text, "One more observation at 1.6 Hz in the field of soft would shrink the interval of E/μ to 87 %");
    EXPECT_EQ(cells_of(text, "starts that converged").at(0), "30 of 32");
    expect_in(text, "data = [&quot;soft.csv&quot;");
  }

  TEST(CalibrationReport, WarningsAreShown)
  {
    CalibrationResult result = synthetic_calibration();
    result.warnings          = {"outside <what> was trained"};
    expect_in(page_of(result), "class=\"warning\">outside &lt;what&gt; was trained");
  }

  TEST(CalibrationReport, IsMadeForAFolderWithAResult)
  {
    const TemporaryFolder folder;
    EXPECT_FALSE(is_calibration(folder.path));
    write_calibration_result(folder.path / "calibration.json", synthetic_calibration());
    EXPECT_TRUE(is_calibration(folder.path));
    const CalibrationResult read = read_calibration_result(folder.path / "calibration.json");
    EXPECT_EQ(page_of(read), page_of(synthetic_calibration()));
  }
} // namespace swimtwin
