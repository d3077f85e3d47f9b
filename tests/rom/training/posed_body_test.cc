// Where a body is put that a model's fluid is sampled around, or whose fields are replayed.
#include <rom/training/posed_body.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// Of the body's surface, by area; its half in space, whose other half has the same.
    template <int dim>
    Point<dim> middle(const Scene &scene, const std::array<double, 2> &center_m, const double angle_rad)
    {
      const Swimmer<dim> swimmer(scene, MPI_COMM_SELF);
      Configuration<dim> c = swimmer.configuration_at_rest();
      for (int i = 0; i < 2; ++i)
        c.pose.center[i] = center_m[i];
      c.pose.set_attitude(Attitude<dim>::about_z(angle_rad));
      return c.pose.to_laboratory(swimmer.arm_to_middle(c.shape));
    }

    template <int dim>
    void expect_middle_to_stay(const Scene &scene, const double angle_rad)
    {
      const auto rest   = middle<dim>(scene, scene.head.center_m, scene.head.angle_rad),
                 turned = middle<dim>(scene, turned_center_m(scene, angle_rad), angle_rad);
      EXPECT_LT(rest.distance(turned), 1e-15) << scene.name;
    }
  } // namespace

  TEST(TurnedCenter, LeavesTheMiddleWhereItIs)
  {
    expect_middle_to_stay<2>(shipped_scene("reference-2d-paper"), .7);
    expect_middle_to_stay<2>(shipped_scene("reference-2d-paper", {"head.center_m=[2e-3, 1.5e-3]"}), -1.3);
    expect_middle_to_stay<2>(shipped_scene("reference-2d-paper", {"head.center_m=[-3e-3, 1e-3]", "head.angle_rad=0.4"}),
                             -.5);
    expect_middle_to_stay<3>(shipped_scene("reference-3d-paper", {"variant=quick"}), .7);
    expect_middle_to_stay<3>(shipped_scene("reference-3d-paper", {"variant=quick", "head.center_m=[2e-3, 1.5e-3]"}),
                             -1.3);
  }

  // The middle of a rectangle's outline and of a triangle's behind it, by hand.
  TEST(TurnedCenter, MovesTheHeadAsFarAsTheMiddleIsBehindIt)
  {
    const Scene  scene = shipped_scene("reference-2d-paper", {"tail.tip=flat"});
    const double a = scene.head.size_m[0], b = scene.head.size_m[1], l = scene.tail->length_m,
                 root = scene.tail->root_height_m, tip = scene.tail->tip_height_m,
                 side = std::hypot(l, .5 * (root - tip)), head = 2. * a + 2. * b - root, total = head + 2. * side + tip;
    const double arm  = (.5 * a * (b - root) - .5 * a * b + 2. * side * .5 * (a + l) + tip * (.5 * a + l)) / total;
    const auto [x, y] = turned_center_m(scene, .7);
    EXPECT_NEAR(x - scene.head.center_m[0], arm * (1. - std::cos(.7)), 1e-9);
    EXPECT_NEAR(y - scene.head.center_m[1], -arm * std::sin(.7), 1e-9);
  }

  TEST(TurnedCenter, IsTheScenesWhereTheDomainMovesAlong)
  {
    const Scene scene = shipped_scene("open-2d");
    EXPECT_EQ(turned_center_m(scene, .7), scene.head.center_m);
  }
} // namespace swimtwin
