#include <twin/filter/noise_level.h>

#include <gtest/gtest.h>

#include <random>

namespace swimtwin
{
  namespace
  {
    /// After many innovations of this noise, with as much again of the state's.
    double learned_sigma(const double first_sigma, const double sigma, const double sigma_of_state, const int n)
    {
      NoiseLevel                       level{first_sigma * first_sigma, 0.};
      std::mt19937_64                  random(1);
      std::normal_distribution<double> innovation(0., std::hypot(sigma, sigma_of_state));
      for (int i = 0; i < n; ++i)
      {
        const double r = innovation(random);
        level.learn(r * r, sigma_of_state * sigma_of_state);
      }
      return level.sigma();
    }

    TEST(NoiseLevel, FindsTheNoiseFromAnyFirstGuess)
    {
      for (const double first_sigma : {0.02, 0.2, 2.})
      {
        EXPECT_NEAR(learned_sigma(first_sigma, 0.2, 0.02, 2000), 0.2, 0.02) << first_sigma;
        EXPECT_NEAR(learned_sigma(first_sigma, 0.2, 0.1, 2000), 0.2, 0.03) << first_sigma;
      }
    }

    // As at a start: the first sight of an angle of which nothing was known, and which is met by chance.
    TEST(NoiseLevel, LearnsNothingWhereTheStateIsUnknown)
    {
      NoiseLevel level{3e-4, 0.};
      level.learn(0., 0.25);
      EXPECT_NEAR(level.variance, 3e-4, 1e-6);
      level.learn(1., 0.25);
      EXPECT_NEAR(level.variance, 3e-4, 1e-6);
    }
  } // namespace
} // namespace swimtwin
