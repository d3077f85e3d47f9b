#include <tests/pipeline/simulation.h>

#include <algorithm>
#include <cmath>
#include <iostream>

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
      displacement_changes.push_back(std::abs(fine.net_displacement_m.value() - coarse.net_displacement_m.value()));
      std::cout << "refinement " << i << ": motion changes by " << motion_changes.back()
                << " body lengths, displacement by " << displacement_changes.back() << " m, power imbalance "
                << coarse.worst_power_imbalance.value() << " to " << fine.worst_power_imbalance.value() << std::endl;
      EXPECT_GE(std::abs(coarse.worst_power_imbalance.value() / fine.worst_power_imbalance.value()), 3.)
          << "refinement " << i;
    }
    for (std::size_t i = 1; i < motion_changes.size(); ++i)
    {
      EXPECT_GE(motion_changes[i - 1] / motion_changes[i], 3.) << "refinement " << i;
      EXPECT_GE(displacement_changes[i - 1] / displacement_changes[i], 3.) << "refinement " << i;
    }
    EXPECT_LE(motion_changes[1] / motion_changes[2], 5.);
    EXPECT_LE(displacement_changes[2], 0.01 * motions[2].summary.net_displacement_m.value());
  }

  // A rigid body that swings goes as it came and gets nowhere without inertia; at 1e9 Pa what is left of the stroke of
  // a soft tail, proportional to 1/E, is below 1e-6 of the length. BDF2 lets a point at the distance l from the one
  // about which the body turns drift by dt^3/4 times the integral of l cos(theta) (theta''^2 + theta'^4 / 3) over the
  // period (docs/equations.md, section 6): at 25 steps, the head's centre by 4e-3 lengths. The advanced point is closer
  // by ten.
  TEST(TimeSteps, ReciprocalSwingOfAStiffSwimmerDoesNotDrift)
  {
    const Motion motion =
        simulate(coarse_swimmer(25, 2.).with({"tail.young_modulus_Pa=1e9", "field.frequency_Hz=0.1"}));
    double swing = 0.;
    for (const auto &row : motion.trajectory)
      swing = std::max(swing, std::abs(row.head_angle_rad));
    EXPECT_GT(swing, 0.7);
    EXPECT_LE(std::abs(motion.summary.net_displacement_m.value()), 4e-4 * body_length_m);
  }
} // namespace swimtwin
