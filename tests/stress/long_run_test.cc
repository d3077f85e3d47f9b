#include <tests/stress/hard_swimmers.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace swimtwin
{
  namespace
  {
    struct Stroke
    {
      double peak_energy_J_m, bend_rad;
    };

    Stroke stroke(const Trajectory &trajectory, const int period, const int steps_per_period)
    {
      const auto begin = std::next(trajectory.begin(), period * steps_per_period),
                 end   = std::next(begin, steps_per_period + 1);
      const auto bend  = [](const TrajectoryRow &row) { return row.tail_angle_rad - row.head_angle_rad; };
      const auto [least, most] =
          std::minmax_element(begin, end, [&](const auto &a, const auto &b) { return bend(a) < bend(b); });
      const auto peak = std::max_element(
          begin, end, [](const auto &a, const auto &b) { return a.elastic_energy_J_m < b.elastic_energy_J_m; });
      return {peak->elastic_energy_J_m, bend(*most) - bend(*least)};
    }
  } // namespace

  // In a long open box every period is the same once the heading has settled (0.3 s), but for the distance to the ends;
  // only errors can add up.
  TEST(LongRun, DriftsNeitherInShapeNorInBalance)
  {
    constexpr int     n = 40, periods = 6, settled = 2;
    const ShrunkScene scene =
        hard_swimmer({"numerics.mesh_size_m=5e-4", "numerics.mesh_size_corner_m=1.5e-4", "numerics.mesh_growth=0.7",
                      "numerics.mesh_size_far_m=5e-3", "domain.size_m=[60e-3, 20e-3]"},
                     n, periods);
    const Motion motion = expect_convergence(scene, n);
    ASSERT_EQ(motion.trajectory.size(), n * periods + 1);
    const Stroke first = stroke(motion.trajectory, settled, n), last = stroke(motion.trajectory, periods - 1, n);
    EXPECT_NEAR(last.peak_energy_J_m, first.peak_energy_J_m, 0.005 * first.peak_energy_J_m);
    EXPECT_NEAR(last.bend_rad, first.bend_rad, 0.005 * first.bend_rad);
  }
} // namespace swimtwin
