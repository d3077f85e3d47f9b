#include <tests/pipeline/simulation.h>

#include <iostream>

namespace swimtwin
{
  namespace
  {
    /// Four tenths of a period, each step iterated to 1e-9 body lengths.
    const ShrunkScene converged_steps =
        coarse_swimmer(50, 0.4).with({"numerics.coupling_tolerance=1e-9", "numerics.linear_tolerance=1e-11"});

    class FixedPoint : public testing::TestWithParam<const char *>
    {
    protected:
      ShrunkScene partitioned(const ShrunkScene &scene) const
      {
        return scene.with({"numerics.coupling=fixed-point", std::string("numerics.acceleration=") + GetParam()});
      }
    };
  } // namespace

  // Same spaces, meshes and implicit geometry: the couplings are ways to solve the same equations.
  TEST_P(FixedPoint, MovesTheSwimmerAsTheMonolithicCouplingDoes)
  {
    const Motion one = simulate(converged_steps), two = simulate(partitioned(converged_steps));
    ASSERT_EQ(one.summary.n_remeshes + two.summary.n_remeshes + two.summary.n_step_halvings, 0);
    const double difference = distance(one.trajectory, two.trajectory);
    std::cout << GetParam() << " against monolithic: " << difference << " body lengths, "
              << two.summary.coupling_iterations_mean.value() << " and " << one.summary.coupling_iterations_mean.value()
              << " iterations per step" << std::endl;
    EXPECT_LE(difference, 1e-7);
    EXPECT_LE(largest_angle_difference(one.trajectory, two.trajectory), 1e-7);
    EXPECT_GT(two.summary.n_tail_linear_solves, two.summary.n_steps);
    EXPECT_EQ(one.summary.n_tail_linear_solves, 0);
  }

  // The whole of it, turned out of the plane.
  TEST(FixedPointInSpace, MovesTheSwimmerAsTheMonolithicCouplingDoes)
  {
    const auto   scene = coarse_swimmer_in_space(0.05).with({"field.bz_T=3e-3", "numerics.coupling_tolerance=1e-9"});
    const Motion one   = simulate(scene),
                 two   = simulate(scene.with({"numerics.coupling=fixed-point", "numerics.acceleration=iqn-ils"}));
    ASSERT_EQ(one.summary.n_remeshes + two.summary.n_remeshes + two.summary.n_step_halvings, 0);
    EXPECT_GT(two.summary.n_tail_linear_solves, two.summary.n_steps);
    EXPECT_EQ(one.summary.n_tail_linear_solves, 0);
    EXPECT_LE(distance(one.trajectory, two.trajectory), 1e-7);
    EXPECT_LE(largest_angle_difference(one.trajectory, two.trajectory), 1e-7);
    EXPECT_LE(std::abs(one.trajectory.back().head_z_m - two.trajectory.back().head_z_m), 1e-7 * body_length_m);
    EXPECT_GT(std::abs(one.trajectory.back().head_z_m), 1e-6 * body_length_m);
  }

  // The reference study's solvers find the same motion as factors do.
  TEST(FixedPointInSpace, IteratesAsItFactorises)
  {
    const auto scene = coarse_swimmer_in_space(0.025).with(
        {"numerics.coupling=fixed-point", "numerics.acceleration=iqn-ils", "numerics.mesh_motion=weighted-harmonic"});
    const Motion one = simulate(scene),
                 two = simulate(scene.with({"numerics.linear_solver=iterative", "numerics.linear_tolerance=1e-10"}));
    std::cout << one.summary.linear_iterations_mean.value() << " and " << two.summary.linear_iterations_mean.value()
              << " iterations per solve" << std::endl;
    EXPECT_LE(distance(one.trajectory, two.trajectory), 1e-7);
    EXPECT_GT(two.summary.linear_iterations_mean.value(), 10.);
  }

  TEST_P(FixedPoint, ResumesWhereItWasInterrupted)
  {
    const auto            scene = partitioned(coarse_swimmer(50, 0.4));
    const TemporaryFolder folder;
    simulate(scene, folder.path / "whole");
    {
      ChildProcess interrupted(tool(simulate_arguments(scene, folder.path / "resumed")));
      ASSERT_TRUE(interrupted.wait_for_file(folder.path / "resumed/checkpoint.h5"));
      ASSERT_TRUE(interrupted.kill());
    }
    simulate(scene, folder.path / "resumed", {"--resume"});
    EXPECT_LE(distance(read_motion(folder.path / "whole").trajectory, read_motion(folder.path / "resumed").trajectory),
              1e-9);
  }

  INSTANTIATE_TEST_SUITE_P(Accelerations, FixedPoint, testing::Values("aitken", "iqn-ils"), [](const auto &test) {
    return std::string(test.param) == "aitken" ? "Aitken" : "QuasiNewton";
  });
} // namespace swimtwin
