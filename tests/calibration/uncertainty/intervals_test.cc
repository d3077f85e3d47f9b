#include <calibration/uncertainty/intervals.h>
#include <tests/calibration/synthetic_curve.h>

#include <cmath>

namespace swimtwin
{
  TEST(Intervals, CoverageFactorsAreThoseOfTheTables)
  {
    EXPECT_NEAR(coverage_factor(0.95, false, 10), 1.959964, 1e-6);
    EXPECT_NEAR(coverage_factor(0.95, true, 10), 2.228139, 1e-6); // Student's t
  }

  TEST(Intervals, ProfileAndBootstrapAgreeOnTheRegularCase)
  {
    const Setting   setting(two_ratios(), {noisy_curve(exact_curve(12, known_swimmer()), 1)});
    const Estimate  estimate = setting.estimate();
    const Bootstrap samples  = bootstrap(setting.input, estimate, 1000, 1);
    EXPECT_EQ(samples.n_failures, 0);
    for (int j = 0; j < 2; ++j)
    {
      const Profile         profile  = profile_of(setting.input, estimate, j, coverage_factor(0.95, false, 10));
      const ClaimedInterval repeated = bootstrap_interval(setting.input, estimate, samples, j, 0.95);
      const ClaimedInterval curved   = curvature_interval(setting.input, estimate, j, coverage_factor(0.95, false, 10));
      ASSERT_TRUE(profile.interval.is_finite() && repeated.is_finite());
      const double width = *profile.interval.high - *profile.interval.low;
      EXPECT_NEAR(*repeated.high - *repeated.low, width, 0.15 * width);
      EXPECT_NEAR(*repeated.low, *profile.interval.low, 0.15 * width);
      EXPECT_NEAR(*repeated.high, *profile.interval.high, 0.15 * width);
      EXPECT_NEAR(*curved.high - *curved.low, width, 0.05 * width);
    }
  }

  TEST(Intervals, TheProfileReachesItsThresholdAtTheEnds)
  {
    const Setting  setting(two_ratios(), {noisy_curve(exact_curve(12, known_swimmer()), 1)});
    const Estimate estimate = setting.estimate();
    const Profile  profile  = profile_of(setting.input, estimate, 0, 2.);
    Refit          refit(setting.input, estimate);
    const double   least = refit.with_held(0, estimate.x()[0], false).half_square;
    for (const auto &end : {profile.interval.low, profile.interval.high})
      EXPECT_NEAR(2. * (refit.with_held(0, std::log(*end), false).half_square - least), 4., 2e-3);
    EXPECT_EQ(profile.curve.threshold, 4.);
    EXPECT_EQ(profile.curve.name, "young_modulus_over_viscosity_1_s");
  }

  TEST(Intervals, CoverTheTruthAsOftenAsTheySay)
  {
    // 400 fits in bench_calibration; here 60, of which 95 % intervals hold at least 52 in all but 1 of 2,000 tries.
    const ObservationSet exact  = exact_curve(12, known_swimmer());
    const double         factor = coverage_factor(0.95, false, 10);
    int                  held[] = {0, 0};
    for (unsigned int seed = 1; seed <= 60; ++seed)
    {
      const Setting  setting(two_ratios(), {noisy_curve(exact, seed)});
      const Estimate estimate = setting.estimate();
      for (int j = 0; j < 2; ++j)
      {
        const ClaimedInterval interval = profile_of(setting.input, estimate, j, factor).interval;
        const double          truth    = setting.map.value(j, setting.truth()[j]);
        held[j] += *interval.low <= truth && truth <= *interval.high;
      }
    }
    EXPECT_GE(held[0], 52);
    EXPECT_GE(held[1], 52);
  }

  TEST(Intervals, RepeatedExperimentsAreTheSameForAnyNumberOfThreads)
  {
    Setting        setting(two_ratios(), {noisy_curve(exact_curve(6, known_swimmer()), 1)});
    const Estimate estimate   = setting.estimate();
    setting.input.n_threads   = 1;
    const Eigen::MatrixXd one = bootstrap(setting.input, estimate, 20, 3).x;
    setting.input.n_threads   = 2;
    EXPECT_EQ(one, bootstrap(setting.input, estimate, 20, 3).x);
    EXPECT_NE(one, bootstrap(setting.input, estimate, 20, 4).x);
  }

  TEST(Intervals, AreOpenWhereTheBoundsEndFirst)
  {
    CalibrationProblem problem = two_ratios();
    problem.free[0].upper      = 8e4 / 1.52 * 1.005;
    const Setting         setting(problem, {exact_curve(6, known_swimmer())});
    const Estimate        estimate = setting.estimate();
    const ClaimedInterval interval = profile_of(setting.input, estimate, 0, 1.96).interval;
    EXPECT_TRUE(interval.low);
    EXPECT_FALSE(interval.high);
    EXPECT_NE(interval.note.find("up to the bound"), std::string::npos);
  }

  TEST(Intervals, DrawsFromTheCurvatureHaveItsCovariance)
  {
    const Setting         setting(two_ratios(), {exact_curve(6, known_swimmer())});
    const Estimate        estimate = setting.estimate();
    const Eigen::MatrixXd draws    = draws_from_curvature(estimate, 4000, 1);
    const Eigen::MatrixXd centred  = draws.rowwise() - draws.colwise().mean();
    const Eigen::MatrixXd sample   = centred.transpose() * centred / 3999.;
    EXPECT_LT((sample - estimate.information.covariance).norm(), 0.1 * estimate.information.covariance.norm());
  }

  TEST(Forecast, ANextObservationShortensTheIntervalAsPromised)
  {
    const ObservationSet set = noisy_curve(exact_curve(6, known_swimmer()), 1);
    const Setting        setting(two_ratios(), {set});
    const Estimate       estimate = setting.estimate();
    const Forecast       curves   = forecast(setting.input, estimate, setting.sets, 9);
    const auto           next     = next_experiment(setting.input, estimate, curves, 0);
    ASSERT_TRUE(next);
    EXPECT_LT(next->best_interval_ratio, 1.);

    // The same set with that observation added: the information of seven instead of six.
    ObservationSet more = set;
    Observation    added;
    added.frequency_Hz   = next->best_frequency_Hz * 1.0001;
    added.displacement_m = 1e-5;
    added.sigma_m        = setting.data.sigma_at(0, next->best_frequency_Hz);
    more.points.insert(std::find_if(more.points.begin(), more.points.end(),
                                    [&](const Observation &p) { return p.frequency_Hz > added.frequency_Hz; }),
                       added);
    const Setting      larger(two_ratios(), {more});
    ExactDisplacements exact(reference_swimmer(), larger.data.conditions, {.n_threads = 2});
    Estimate           of_seven = estimate;
    of_seven.error              = model_error(reference_model().record, 0., larger.data, Eigen::VectorXd::Ones(7));
    const Misfit      misfit    = misfit_of(larger.input, of_seven);
    const Information both = information(misfit, estimate.unknowns, misfit.predict(exact, estimate.unknowns, true));
    EXPECT_NEAR(std::sqrt(both.covariance(0, 0) / estimate.information.covariance(0, 0)), next->best_interval_ratio,
                2e-3);

    const PredictionBand band = prediction_band(setting.input, estimate, curves.curves[0], 1.96);
    for (std::size_t i = 0; i < band.value.size(); ++i)
    {
      EXPECT_LT(band.low[i], band.value[i]);
      EXPECT_LT(band.observation_low[i], band.low[i]);
      EXPECT_GT(band.observation_high[i], band.high[i]);
    }
  }
} // namespace swimtwin
