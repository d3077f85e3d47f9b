#include <reports/fit/calibration_pictures.h>

#include <reports/fit/pairs_picture.h>
#include <reports/fit/profiles_picture.h>
#include <reports/fit/waterfall_picture.h>
#include <reports/page/draw_pictures.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/reports/synthetic_calibration.h>

#include <algorithm>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::vector<std::string> names_of(const std::vector<GnuplotPicture> &pictures)
    {
      std::vector<std::string> names;
      for (const GnuplotPicture &picture : pictures)
        names.push_back(picture.name);
      return names;
    }

    std::string variable(const GnuplotPicture &picture, const std::string &name)
    {
      for (const auto &[key, value] : picture.variables)
        if (key == name)
          return value;
      return "";
    }

    /// Rows of a block as gnuplot's `index` counts them.
    std::vector<std::vector<double>> block(const GnuplotPicture &picture, const int index)
    {
      std::istringstream               text(picture.table.text());
      std::vector<std::vector<double>> rows;
      int                              current = -1;
      for (std::string line; std::getline(text, line);)
      {
        current += line.starts_with('#') ? 1 : 0;
        if (current != index || line.starts_with('#') || line.empty())
          continue;
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; cells >> cell;)
          rows.back().push_back(std::stod(cell));
      }
      return rows;
    }

    using Names = std::vector<std::string>;
  } // namespace

  TEST(CalibrationPictures, AreAllDrawn)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    std::string           warning;
    const auto drawn = draw_pictures(folder.path, calibration_pictures(synthetic_calibration()), "a test", warning);
    EXPECT_EQ(warning, "");
    ASSERT_EQ(drawn.size(), 5u);
    for (const auto &png : drawn)
      EXPECT_EQ(content(png).substr(0, 4), "\x89PNG") << png;
  }

  TEST(CalibrationPictures, OnlyWhatTheResultHasIsShown)
  {
    EXPECT_EQ(names_of(calibration_pictures(synthetic_calibration())),
              (Names{"fit", "profiles", "pairs", "waterfall", "next_experiment"}));
    EXPECT_EQ(names_of(calibration_pictures(synthetic_calibration(1))),
              (Names{"fit", "profiles", "waterfall", "next_experiment"}));
    CalibrationResult bare = synthetic_calibration();
    bare.profiles.clear();
    bare.bootstrap.resize(0, 0);
    bare.starts.resize(1);
    bare.next.reset();
    EXPECT_EQ(names_of(calibration_pictures(bare)), Names{"fit"});
    EXPECT_TRUE(calibration_pictures(CalibrationResult()).empty());
  }

  TEST(CalibrationPictures, UndeterminedFitsCanBeDrawn)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    CalibrationResult result = synthetic_calibration();
    result.covariance.setConstant(std::nan(""));
    result.bands.clear();
    for (CalibratedParameter &parameter : result.parameters)
    {
      parameter.standard_error.reset();
      parameter.undetermined = true;
      parameter.profile      = {"profile", std::nullopt, std::nullopt, "flat"};
    }
    for (ParameterProfile &profile : result.profiles)
      std::fill(profile.misfit_increase.begin(), profile.misfit_increase.end(), 0.);
    const TemporaryFolder folder;
    std::string           warning;
    EXPECT_EQ(draw_pictures(folder.path, calibration_pictures(result), "a test", warning).size(), 4u);
    EXPECT_EQ(warning, "");
  }

  TEST(FitPicture, ShowsEveryObservationOfEverySetInMillimetres)
  {
    const CalibrationResult result  = synthetic_calibration();
    const GnuplotPicture    picture = fit_picture(result);
    EXPECT_EQ(variable(picture, "name_1"), "'stiff'");
    for (const int set : {0, 1})
    {
      const auto curve = block(picture, 3 * set), observed = block(picture, 3 * set + 1);
      EXPECT_EQ(curve.size(), result.bands[0].value.size());
      ASSERT_EQ(observed.size(), 12u);
      EXPECT_NEAR(observed[3][1], 1e3 * result.residuals[static_cast<std::size_t>(12 * set + 3)].observed, 1e-9);
      for (const auto &row : curve)
      {
        EXPECT_LT(row[2], row[1]);
        EXPECT_LT(row[4], row[2]);
        EXPECT_GT(row[3], row[1]);
        EXPECT_GT(row[5], row[3]);
      }
    }
    expect_in(variable(picture, "caption"),
              "converged; χ² = 21.4 with 21 degrees of freedom; bands: 95 % of the curve");
  }

  TEST(FitPicture, MarksWhatTheLossHardlyCounts)
  {
    CalibrationResult result = synthetic_calibration();
    EXPECT_EQ(variable(fit_picture(result), "has_outliers"), "0");
    result.residuals[4].weight       = 0.1;
    result.residuals[4].standardised = -9.;
    EXPECT_EQ(variable(fit_picture(result), "has_outliers"), "1");
    EXPECT_GT(std::stod(variable(fit_picture(result), "r_max")), 9.);
  }

  TEST(ProfilesPicture, ParabolaMeetsTheThresholdAtTheStandardErrors)
  {
    const CalibrationResult result  = synthetic_calibration();
    const GnuplotPicture    picture = profiles_picture(result);
    const double            value = result.parameters[0].value, sigma = *result.parameters[0].standard_error;
    for (const auto &row : block(picture, 1))
      EXPECT_NEAR(row[1], std::pow(value / sigma * std::log(1e3 * row[0] / value), 2), 1e-5);
    EXPECT_EQ(block(picture, 2).size(), 2u);
    EXPECT_EQ(variable(picture, "name_0"), "'E/μ (10³/s)'");
    EXPECT_NEAR(block(picture, 3)[0][0], 1e-3 * value, 1e-6);
  }

  TEST(PairsPicture, EllipseHoldsItsLevelOfTheSamples)
  {
    const CalibrationResult result  = synthetic_calibration(2);
    const GnuplotPicture    picture = pairs_picture(result);
    EXPECT_EQ(block(picture, 0).size(), 400u);
    double n_counted = 0.;
    for (const auto &row : block(picture, 1))
      n_counted += row[1];
    EXPECT_EQ(n_counted, 400.);
    const Eigen::Matrix2d inverse  = result.covariance.inverse();
    const auto            distance = [&](const double a, const double b) {
      const Eigen::Vector2d step(std::log(a / result.parameters[0].value), std::log(b / result.parameters[1].value));
      return step.dot(inverse * step);
    };
    for (const auto &row : block(picture, 3)) // both parameters in thousands
      EXPECT_NEAR(distance(1e3 * row[0], 1e3 * row[1]), -2. * std::log(0.05), 1e-4);
    double inside = 0.;
    for (const auto &row : block(picture, 0))
      inside += distance(1e3 * row[0], 1e3 * row[1]) < -2. * std::log(0.05) ? 1. : 0.;
    EXPECT_NEAR(inside / 400., 0.95, 3. * std::sqrt(0.95 * 0.05 / 400.));
  }

  TEST(PairsPicture, LeavesOutWhatTheDataDoNotDecide)
  {
    CalibrationResult result          = synthetic_calibration(3);
    result.parameters[0].undetermined = true;
    ASSERT_TRUE(has_pairs(result));
    const GnuplotPicture picture = pairs_picture(result);
    EXPECT_EQ(variable(picture, "name_1"), "'displacement scale'");
    EXPECT_NEAR(block(picture, 0)[7][1], result.bootstrap(7, 2), 1e-9);
    EXPECT_NEAR(block(picture, 3)[0][1],
                1.003 * std::exp(std::sqrt(-2. * std::log(0.05)) * result.covariance(1, 2) /
                                 std::sqrt(result.covariance(1, 1))),
                1e-8);
    result.parameters[1].undetermined = true;
    EXPECT_FALSE(has_pairs(result));
  }

  TEST(PairsPicture, NoiseLevelIsNotAColumn)
  {
    CalibrationResult result = synthetic_calibration(2);
    result.parameters.push_back(synthetic_parameter("noise_scale", 1., 0.1));
    EXPECT_EQ(std::stod(variable(pairs_picture(result), "n_parameters")), 2.);
  }

  TEST(WaterfallPicture, CountsTheStartsThatReachedTheBest)
  {
    const GnuplotPicture picture = waterfall_picture(synthetic_calibration());
    expect_in(variable(picture, "caption"), "27 of 32 starts reached the best misfit of 9.87");
    EXPECT_EQ(variable(picture, "all_converged"), "0");
    EXPECT_EQ(variable(picture, "logarithmic"), "1");
  }

  TEST(WaterfallPicture, StartsThatFailedDoNotSpoilTheAxis)
  {
    CalibrationResult result         = synthetic_calibration();
    result.starts.back().misfit      = std::nan("");
    result.starts[3].misfit_at_start = INFINITY;
    const GnuplotPicture picture     = waterfall_picture(result);
    EXPECT_LT(std::stod(variable(picture, "m_min")), 9.87);
    EXPECT_LT(std::stod(variable(picture, "m_max")), 1e5);
  }

  TEST(NextExperimentPicture, NamesTheBestFrequency)
  {
    expect_in(variable(next_experiment_picture(synthetic_calibration()), "caption"),
              "best at 1.6 Hz: the interval of E/μ shrinks to 87 %");
  }
} // namespace swimtwin
