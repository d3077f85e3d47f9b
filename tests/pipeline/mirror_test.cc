#include <tests/pipeline/simulation.h>

#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    const std::string mirrored_field = "field.by_T=-5e-3";
  } // namespace

  // Reflected at y = 0 a run is the same arithmetic with other signs; only orders of summation may differ.
  TEST(Mirror, AMirroredFieldOnAMirroredMeshGivesTheMirroredMotion)
  {
    const auto   scene  = coarse_swimmer(40, 1.);
    const Motion motion = simulate(scene);
    const Motion image  = simulate(scene.with({mirrored_field, "numerics.mirror_meshes=true"}));
    ASSERT_EQ(motion.summary.n_remeshes + image.summary.n_remeshes, 0);
    const double difference = distance(motion.trajectory, mirrored(image.trajectory));
    std::cout << "mirrored motion: " << difference << " body lengths" << std::endl;
    EXPECT_LE(difference, 1e-9);
    EXPECT_LE(largest_angle_difference(motion.trajectory, mirrored(image.trajectory)), 1e-8);
  }

  // Meshes as they come, ten of them: what is left is the noise of meshing.
  TEST(Mirror, WithRemeshingTheDisplacementIsTheSameToAFifthOfAPercent)
  {
    const ShrunkScene scene{"reference-2d-casefile",
                            {"time.periods=2", "time.steps_per_period=50", "numerics.remesh_every_steps=10"}};
    const Motion      motion = simulate(scene), image = simulate(scene.with({mirrored_field}));
    EXPECT_GE(motion.summary.n_remeshes, 8);
    EXPECT_GE(image.summary.n_remeshes, 8);
    const double displacement = motion.summary.net_displacement_m.value();
    std::cout << "mirrored motion with remeshing: "
              << 100. * (image.summary.net_displacement_m.value() / displacement - 1.) << " % of the displacement"
              << std::endl;
    EXPECT_NEAR(image.summary.net_displacement_m.value(), displacement, 0.002 * std::abs(displacement));
  }

  // In space meshes are not reflected at y = 0: what is left is how far a mesh is from its own mirror image.
  TEST(Mirror, AMirroredFieldGivesTheMirroredMotionInSpace)
  {
    const auto   scene  = coarse_swimmer_in_space(0.5);
    const Motion motion = simulate(scene), image = simulate(scene.with({mirrored_field}));
    ASSERT_EQ(motion.trajectory.size(), image.trajectory.size());
    const double way        = .5 * distance(motion.trajectory, image.trajectory),
                 difference = distance(motion.trajectory, mirrored(image.trajectory));
    std::cout << "mirrored motion in space: " << difference << " of a motion of " << way << " body lengths"
              << std::endl;
    EXPECT_LE(difference, 0.01 * way);
    EXPECT_GE(way, 0.1);
  }
} // namespace swimtwin
