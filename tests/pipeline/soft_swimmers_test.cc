#include <tests/pipeline/simulation.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    struct SoftSwimmer
    {
      const char *name, *scene, *young_modulus, *magnetization, *frequency;
    };

    void PrintTo(const SoftSwimmer &swimmer, std::ostream *stream) // how GoogleTest names a case
    {
      *stream << swimmer.name;
    }

    const SoftSwimmer paper{"Paper", "reference-2d-paper", "2e5", "1e5", "0.2"};
    const SoftSwimmer casefile{"Casefile", "reference-2d-casefile", "8e4", "2e5", "0.3"};

    class SlowField : public testing::TestWithParam<std::tuple<SoftSwimmer, int>>
    {
    };
  } // namespace

  // Low frequencies swing the head by more than 60 degrees: a scheme of one solve per step turned tail triangles inside
  // out here.
  TEST_P(SlowField, IsSwumThroughWithTheBalanceClosed)
  {
    const auto &[swimmer, n] = GetParam();
    const auto motion        = simulate({swimmer.scene,
                                         {std::string("tail.young_modulus_Pa=") + swimmer.young_modulus,
                                          std::string("head.magnetization_A_m=") + swimmer.magnetization,
                                          std::string("field.frequency_Hz=") + swimmer.frequency, "time.periods=1",
                                          "time.steps_per_period=" + std::to_string(n), "numerics.mesh_growth=0.6"}});
    EXPECT_EQ(motion.summary.status, "completed");
    EXPECT_EQ(motion.trajectory.size(), n + 1);
    EXPECT_LE(std::abs(motion.summary.power_imbalance.value()), 0.01);
  }

  INSTANTIATE_TEST_SUITE_P(HardCases, SlowField,
                           testing::Combine(testing::Values(paper, casefile), testing::Values(40, 80)),
                           [](const auto &test) {
                             return std::get<0>(test.param).name + std::to_string(std::get<1>(test.param));
                           });

  // A closed domain lets no divergence pass, and a stiff tail answers area strain with a large force: an iteration in
  // which a rigid turn has either one creeps, and ends far from the solution.
  TEST(StiffTail, InAClosedDomainTakesNoMoreIterationsThanASoftOne)
  {
    const auto motion = simulate(
        {"open-2d",
         {"tail.young_modulus_Pa=1e8", "time.periods=1", "time.steps_per_period=40", "numerics.mesh_growth=0.6"}});
    EXPECT_LE(motion.summary.coupling_iterations_mean.value(), 2.);
    EXPECT_EQ(motion.summary.n_remeshes + motion.summary.n_step_halvings, 0);
    EXPECT_LE(std::abs(motion.summary.power_imbalance.value()), 1e-3);
  }

  // The scene moves with the swimmer, so that every period is like the last. A tail whose area grew by a ten-thousandth
  // per period, as the rate alone would let it, stored 1e-3 more energy in period 4 than in period 3.
  TEST(ClosedDomain, KeepsTheTailsAreaOverPeriods)
  {
    constexpr int n      = 40;
    const auto    motion = simulate({"open-2d",
                                     {"time.periods=4", "time.steps_per_period=40", "numerics.mesh_size_m=5e-4",
                                      "numerics.mesh_size_corner_m=1.5e-4", "numerics.mesh_growth=0.7"}});
    ASSERT_EQ(motion.trajectory.size(), 4 * n + 1);
    const auto peak = [&](const int period) {
      double largest = 0.;
      for (int i = period * n; i <= (period + 1) * n; ++i)
        largest = std::max(largest, motion.trajectory[i].elastic_energy_J_m);
      return largest;
    };
    std::cout << "peak energy of periods 3 and 4: " << peak(2) << ", " << peak(3) << " J/m" << std::endl;
    EXPECT_NEAR(peak(3), peak(2), 2e-4 * peak(2));
  }
} // namespace swimtwin
