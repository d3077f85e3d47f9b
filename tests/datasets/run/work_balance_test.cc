#include <datasets/run/work_balance.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    /// Constant powers on rows a second apart, ten to a period.
    Trajectory steady(const int n_steps, const double magnetic, const double dissipation)
    {
      Trajectory rows(static_cast<std::size_t>(n_steps) + 1);
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        rows[i].time_s             = static_cast<double>(i);
        rows[i].magnetic_power_W_m = magnetic;
        rows[i].dissipation_W_m    = dissipation;
      }
      return rows;
    }
  } // namespace

  TEST(WorkBalance, KnownWorksStandInForThePowersOfTheFirstIntervals)
  {
    Trajectory rows            = steady(20, 2., 2.);
    rows[0].magnetic_power_W_m = 0.; // the load has just jumped: powers do not tell the first interval
    const auto by_powers       = work_balance_per_period(rows, 10.);
    const auto by_works        = work_balance_per_period(rows, 10., std::vector<IntervalWork>{{2., 0., 2.}});
    EXPECT_NEAR(by_powers[0].imbalance().value(), -1. / 19., 1e-14);
    EXPECT_NEAR(by_works[0].imbalance().value(), 0., 1e-14);
    EXPECT_NEAR(by_works[0].magnetic_J_m, 20., 1e-13);
    EXPECT_EQ(by_works[1].magnetic_J_m, by_powers[1].magnetic_J_m);
  }

  TEST(WorkBalance, KnownWorksMayReachIntoTheNextPeriod)
  {
    const auto periods =
        work_balance_per_period(steady(20, 2., 2.), 10., std::vector<IntervalWork>(12, IntervalWork{3., 0., 3.}));
    EXPECT_NEAR(periods[0].magnetic_J_m, 30., 1e-13);
    EXPECT_NEAR(periods[1].magnetic_J_m, 2. * 3. + 8. * 2., 1e-13);
  }

  TEST(WorkBalance, WithoutWorkAndDissipationThereIsNoImbalance)
  {
    const auto periods = work_balance_per_period(steady(20, 0., 0.), 10.);
    EXPECT_FALSE(periods[0].imbalance().has_value());
    EXPECT_FALSE(worst_period(periods).has_value());
    EXPECT_NEAR(work_balance_per_period(steady(10, 0., 2.), 10.)[0].imbalance().value(), -1., 1e-14);
  }

  TEST(WorkBalance, WorstPeriodIsFoundAmongThoseThatHaveAnImbalance)
  {
    Trajectory rows = steady(30, 0., 0.);
    for (std::size_t i = 11; i < 20; ++i)
      rows[i].magnetic_power_W_m = 1.;
    EXPECT_EQ(worst_period(work_balance_per_period(rows, 10.)), std::optional<std::size_t>(1));
  }

  TEST(WorkBalance, ExpectedImbalanceIsOfSecondOrderWithinItsBounds)
  {
    EXPECT_NEAR(largest_expected_imbalance(100), 0.005, 1e-15);
    EXPECT_NEAR(largest_expected_imbalance(50), 0.02, 1e-15);
    EXPECT_EQ(largest_expected_imbalance(10), 0.05);
    EXPECT_EQ(largest_expected_imbalance(10000), 0.001);
    EXPECT_NEAR(largest_expected_imbalance(100, true), 0.0016, 1e-15);
    EXPECT_NEAR(largest_expected_imbalance(40, true), 0.01, 1e-15);
  }
} // namespace swimtwin
