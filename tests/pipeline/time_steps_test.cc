#include <tests/pipeline/simulation.h>

#include <iostream>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Two periods with the steps of the second one refined by powers of two, everything else converged.
    std::vector<Motion> refined_motions(const std::vector<int> &steps_per_period)
    {
      std::vector<Motion> motions;
      for (const int n : steps_per_period)
        motions.push_back(simulate(
            coarse_swimmer(n, 2.).with({"numerics.coupling_tolerance=1e-9", "numerics.linear_tolerance=1e-9"})));
      return motions;
    }
  } // namespace

  // Differences between consecutive step sizes fall by 4 in the limit; 3 and 5 allow for the next order at 12 steps per
  // half swing. The displacement over a period is the difference of two positions whose errors nearly cancel (its
  // leading coefficient is small and other orders show), so it is only required not to do worse; the whole motion,
  // where nothing cancels, shows the order from both sides. The balance is worst in the first period: there nothing is
  // periodic, and the trapezoidal rule has no better order than BDF2. All are far above the tolerances of 1e-9.
  TEST(TimeSteps, MotionDisplacementAndPowerBalanceConvergeAtSecondOrder)
  {
    const auto          motions = refined_motions({25, 50, 100, 200});
    std::vector<double> motion_changes, displacement_changes;
    for (std::size_t i = 1; i < motions.size(); ++i)
    {
      const RunSummary &coarse = motions[i - 1].summary, &fine = motions[i].summary;
      ASSERT_EQ(fine.n_remeshes + coarse.n_remeshes, 0) << "meshes differ";
      motion_changes.push_back(distance(motions[i - 1].trajectory, motions[i].trajectory, 2));
      displacement_changes.push_back(std::abs(fine.net_displacement_m - coarse.net_displacement_m));
      std::cout << "refinement " << i << ": motion changes by " << motion_changes.back()
                << " body lengths, displacement by " << displacement_changes.back() << " m, power imbalance "
                << coarse.worst_power_imbalance << " to " << fine.worst_power_imbalance << std::endl;
      EXPECT_GE(std::abs(coarse.worst_power_imbalance / fine.worst_power_imbalance), 3.) << "refinement " << i;
    }
    for (std::size_t i = 1; i < motion_changes.size(); ++i)
    {
      EXPECT_GE(motion_changes[i - 1] / motion_changes[i], 3.) << "refinement " << i;
      EXPECT_GE(displacement_changes[i - 1] / displacement_changes[i], 3.) << "refinement " << i;
    }
    EXPECT_LE(motion_changes[1] / motion_changes[2], 5.);
    EXPECT_LE(displacement_changes[2], 0.01 * motions[2].summary.net_displacement_m);
  }
} // namespace swimtwin
