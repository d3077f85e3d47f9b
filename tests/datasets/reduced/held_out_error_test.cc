#include <datasets/reduced/held_out_error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    HeldOutRun run(const double frequency_Hz, const double full_m, const double reduced_m)
    {
      HeldOutRun run;
      run.young_modulus_Pa       = 1e5;
      run.viscosity_Pa_s         = 1.;
      run.magnetization_A_m      = 1e5;
      run.frequency_Hz           = frequency_Hz;
      run.bx_T                   = 5e-3;
      run.by_T                   = 5e-3;
      run.displacement_m         = full_m;
      run.reduced_displacement_m = reduced_m;
      return run;
    }

    /// Good at low frequencies, bad at high ones.
    TrainingRecord record()
    {
      TrainingRecord record;
      record.held_out_runs = {run(.1, 1e-4, 1.001e-4), run(10., 1e-4, 1.2e-4)};
      return record;
    }
  } // namespace

  TEST(HeldOutError, IsTheRootMeanSquareAndTheWorst)
  {
    const HeldOutError error = displacement_error(record());
    EXPECT_NEAR(error.worst, .2, 1e-12);
    EXPECT_NEAR(error.rms, std::sqrt((.04 + 1e-6) / 2.), 1e-12);
    EXPECT_FALSE(error.is_within(.05));
    EXPECT_TRUE(error.is_within(.15));
  }

  TEST(HeldOutError, OfATinyDisplacementIsRelativeToTheLargest)
  {
    TrainingRecord with_zero;
    with_zero.held_out_runs = {run(1., 1e-4, 1e-4), run(1., 0., 1e-7)};
    EXPECT_NEAR(displacement_error(with_zero).worst, .02, 1e-12);
  }

  TEST(HeldOutError, AMissedTargetIsSaidInOneSentence)
  {
    EXPECT_NE(missed_target(record()).find("off by 14 % (rms), 20 % (worst) in 2 full-order runs"), std::string::npos);
    TrainingRecord modest = record();
    modest.target         = .2;
    EXPECT_EQ(missed_target(modest), "");
    EXPECT_EQ(missed_target({}), ""); // unknown is not missed
    EXPECT_FALSE(displacement_error({}).is_known());
  }

  TEST(HeldOutError, NearbyIsThatOfTheNearestRunsAndFarFromAllThatOfAll)
  {
    EXPECT_LT(*error_nearby(record(), run(.1, 0., 0.)), .05);
    EXPECT_GT(*error_nearby(record(), run(10., 0., 0.)), .19);
    EXPECT_NEAR(*error_nearby(record(), run(1e6, 0., 0.)), displacement_error(record()).rms, 1e-9);
    EXPECT_FALSE(error_nearby({}, run(1., 0., 0.)));
  }

  // Student's distribution with as many degrees of freedom as runs: 2.306 for eight.
  TEST(HeldOutError, BoundIsStudentsQuantileTimesTheErrorsSize)
  {
    TrainingRecord alike;
    for (int k = 0; k < 8; ++k)
      alike.held_out_runs.push_back(run(1., 1e-4 * (k % 2 == 0 ? 1. / 1.01 : 1. / .99), 1e-4));
    const double bound_m = error_bound_m(alike, {1e-4, 0.});
    EXPECT_NEAR(bound_m, 2.306 * 1e-6, .01e-6);
    EXPECT_NEAR(error_bound_m(alike, {2e-4, 0.}), 2. * bound_m, 1e-12);
    EXPECT_TRUE(std::isnan(error_bound_m({}, {1e-4, 0.})));
  }

  TEST(HeldOutError, BoundGrowsWhereFitsToHalfOfTheSamplesDisagree)
  {
    const double quiet_m = error_bound_m(record(), {1e-4, 0.}), loud_m = error_bound_m(record(), {1e-4, 5e-6});
    EXPECT_NEAR(loud_m / quiet_m, std::hypot(.005, .05) / .005, 1e-9);
    TrainingRecord told                = record();
    told.held_out_runs[1].fit_change_m = 2e-5; // the bad run was known to be bad
    EXPECT_LT(error_bound_m(told, {1e-4, 0.}), .1 * quiet_m);
  }

  TEST(HeldOutError, ScalesWithStiffnessViscosityAndMagnetizationTogether)
  {
    HeldOutRun scaled = run(.1, 0., 0.);
    scaled.young_modulus_Pa *= 3.;
    scaled.viscosity_Pa_s *= 3.;
    scaled.magnetization_A_m *= 3.;
    EXPECT_NEAR(*error_nearby(record(), scaled), *error_nearby(record(), run(.1, 0., 0.)), 1e-12);
  }
} // namespace swimtwin
