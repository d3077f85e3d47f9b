#include <tests/pipeline/simulation.h>

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

  // Distances between consecutive step sizes fall by 4 in the limit. The displacement over a period is the difference
  // of two positions whose errors nearly cancel (its leading coefficient is small and other orders show), so it is only
  // required not to do worse; the whole motion, where nothing cancels, shows the order from both sides.
  TEST(TimeSteps, MotionAndDisplacementConvergeAtSecondOrder)
  {
    const auto          motions = refined_motions({25, 50, 100, 200});
    std::vector<double> motion_changes, displacement_changes;
    for (std::size_t i = 1; i < motions.size(); ++i)
    {
      motion_changes.push_back(distance(motions[i - 1].trajectory, motions[i].trajectory, 2));
      displacement_changes.push_back(
          std::abs(motions[i].summary.net_displacement_m - motions[i - 1].summary.net_displacement_m));
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
