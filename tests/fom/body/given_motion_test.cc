#include <fom/body/given_motion.h>

#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    const std::vector<std::string> waving_body = {"numerics.mesh_size_m=3e-4", "numerics.mesh_size_corner_m=1e-4",
                                                  "tail.wave.phase_rad=0.3"};

    class GivenShape : public ::testing::Test
    {
    protected:
      Scene      scene = shipped_scene("waving-swimmer", waving_body);
      Swimmer<2> swimmer{scene, MPI_COMM_WORLD};

      Point<2> position(const unsigned int node, const double time_s) const
      {
        return swimmer.tail().mesh.nodes[node] + given_shape(swimmer, time_s)[node];
      }
    };
  } // namespace

  TEST_F(GivenShape, LeavesTheRootWhereItIs)
  {
    const auto shape = given_shape(swimmer, .37);
    for (const auto node : swimmer.tail().clamped_nodes)
      EXPECT_LE(shape[node].norm(), 1e-15 * scene.body_length_m());
  }

  // Plane sections stay normal to the axis: area elements far from it are stretched as much as those on the other side
  // are squeezed. What is left is the distance of quadratic edges from the curves.
  TEST_F(GivenShape, KeepsTheArea)
  {
    Configuration<2> configuration = swimmer.configuration_at_rest();
    const double     at_rest       = swimmer.volume(configuration);
    for (const double time_s : {0., .2, .45})
    {
      take_given_configuration(swimmer, time_s, configuration);
      EXPECT_NEAR(swimmer.volume(configuration) / at_rest, 1., 1e-5);
    }
  }

  // Length of the axis by chords between points on it, each shorter than its arc by (curvature * chord)^2 / 24.
  TEST_F(GivenShape, KeepsTheLengthOfTheAxis)
  {
    const auto &[before, middle, tip] = swimmer.tail().axis_at_tip;
    const auto  &nodes                = swimmer.tail().mesh.nodes;
    const double at_rest              = nodes[before].distance(nodes[middle]) + nodes[middle].distance(nodes[tip]);
    const double bent =
        position(before, .1).distance(position(middle, .1)) + position(middle, .1).distance(position(tip, .1));
    EXPECT_NEAR(bent / at_rest, 1., 1e-3);
  }

  TEST_F(GivenShape, TipHasTheGivenAngle)
  {
    Configuration<2> configuration = swimmer.configuration_at_rest();
    take_given_configuration(swimmer, .2, configuration);
    const TailWave &wave = scene.tail->wave;
    const double    angle =
        wave.angle_rad * std::sin(2. * numbers::PI * (wave.frequency_Hz * .2 - wave.waves) + wave.phase_rad);
    EXPECT_NEAR(swimmer.tail_angle(configuration), angle, 2e-3); // of a parabola through the axis' last edge
  }

  TEST(GivenPose, VelocityIsTheDerivative)
  {
    const Scene      scene = shipped_scene("oscillating-disc",
                                           {"head.oscillation.amplitude_m=[1e-4,2e-4]", "head.oscillation.angle_rad=0.3"});
    constexpr double h = 1e-5, t = .123;
    const auto       now = given_pose<2>(scene.head, t), before = given_pose<2>(scene.head, t - h),
               after = given_pose<2>(scene.head, t + h);
    EXPECT_LE(((after.pose.center - before.pose.center) / (2. * h) - now.velocity).norm(), 1e-8 * now.velocity.norm());
    EXPECT_NEAR((after.pose.angle - before.pose.angle) / (2. * h), now.omega[0], 1e-8 * std::abs(now.omega[0]));
  }
} // namespace swimtwin
