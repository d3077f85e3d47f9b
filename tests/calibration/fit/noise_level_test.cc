#include <calibration/fit/noise_level.h>
#include <tests/calibration/synthetic_curve.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// A fit of noisy data whose misfit may be spoiled.
    struct NoisyFit
    {
      explicit NoisyFit(const LossKind loss = LossKind::least_squares)
          : setting(
                [loss] {
                  CalibrationProblem problem = two_ratios();
                  problem.loss               = loss;
                  return problem;
                }(),
                {noisy_curve(exact_curve(12, known_swimmer()), 4)}),
            estimate(setting.estimate()), misfit(misfit_of(setting.input, estimate))
      {
      }

      double noise(const double lower = 0.01, const double upper = 100.) const
      {
        return noise_scale_estimate(misfit, estimate.unknowns, estimate.prediction, lower, upper);
      }

      Setting  setting;
      Estimate estimate;
      Misfit   misfit;
    };
  } // namespace

  TEST(NoiseLevel, OfLeastSquaresIsTheSumOfSquaresOverTheDegreesOfFreedom)
  {
    const NoisyFit        fit;
    const Eigen::VectorXd r = fit.misfit.residuals(fit.estimate.prediction);
    EXPECT_NEAR(fit.noise(), std::sqrt(r.squaredNorm() / 10.), 1e-3 * fit.noise()); // 12 - 2
  }

  TEST(NoiseLevel, OfHalfTheSigmaIsTwiceAsLarge)
  {
    for (const LossKind kind : {LossKind::least_squares, LossKind::cauchy})
    {
      NoisyFit     fit(kind);
      const double whole = fit.noise();
      fit.misfit.sigma_m *= 0.5;
      EXPECT_NEAR(fit.noise(), 2. * whole, 2e-3 * whole) << to_string(kind);
    }
  }

  TEST(NoiseLevel, KeepsToItsBounds)
  {
    for (const LossKind kind : {LossKind::least_squares, LossKind::cauchy})
    {
      const NoisyFit fit(kind);
      const double   free = fit.noise();
      EXPECT_NEAR(fit.noise(2. * free, 4. * free), 2. * free, 2e-3 * free) << to_string(kind);
      EXPECT_NEAR(fit.noise(0.1 * free, 0.5 * free), 0.5 * free, 2e-3 * free) << to_string(kind);
    }
  }

  TEST(NoiseLevel, OfARobustLossDoesNotCareHowFarAnOutlierIs)
  {
    NoisyFit     robust(LossKind::cauchy), of_squares;
    const double robust_before = robust.noise(), of_squares_before = of_squares.noise();
    const auto   move_an_observation = [&] {
      for (Misfit *misfit : {&robust.misfit, &of_squares.misfit})
        misfit->observed_m[3] += 100. * misfit->sigma_m[3];
    };
    move_an_observation();
    const double robust_after = robust.noise();
    EXPECT_LT(robust_after, 2. * robust_before);
    EXPECT_GT(of_squares.noise(), 10. * of_squares_before);
    move_an_observation();
    EXPECT_EQ(robust.noise(), robust_after);
  }

  TEST(NoiseLevel, IsFittedWithTheParameters)
  {
    ObservationSet set = noisy_curve(exact_curve(12, known_swimmer()), 4);
    for (Observation &point : set.points)
      point.sigma_m *= 0.4;
    CalibrationProblem problem = two_ratios();
    problem.free.push_back(free_parameter(FittedQuantity::noise_scale, 0.1, 10.));
    const Setting         setting(problem, {set});
    const Estimate        estimate = setting.estimate();
    const Eigen::VectorXd r        = misfit_of(setting.input, estimate).residuals(estimate.prediction);
    EXPECT_NEAR(r.squaredNorm(), 10., 1e-3); // the sum of squares over 12 - 2 degrees of freedom is 1
    EXPECT_NEAR(estimate.noise_scale, 2.5, 1.2);
  }

  TEST(NoiseLevel, IsFreeOnlyIfTheProblemSaysSo)
  {
    CalibrationProblem problem = two_ratios();
    EXPECT_EQ(free_noise_scale(problem), nullptr);
    problem.free.push_back(free_parameter(FittedQuantity::noise_scale, 0.1, 10.));
    ASSERT_NE(free_noise_scale(problem), nullptr);
    EXPECT_EQ(free_noise_scale(problem)->upper, 10.);
  }
} // namespace swimtwin
