#include <fom/algebra/bdf2.h>
#include <fom/geometry/rigid_pose.h>

#include <deal.II/base/symmetric_tensor.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    Attitude<3> turned(Attitude<3> attitude, const AngularVelocity<3> &rotation)
    {
      attitude.turn(rotation);
      return attitude;
    }

    /// Turning about z while it turns about its own x: neither axis stays.
    Attitude<3> tumbling(const double t)
    {
      return turned(turned({}, AngularVelocity<3>({.7 * std::sin(t), 0., 0.})), AngularVelocity<3>({0., 0., t}));
    }
    AngularVelocity<3> rate_of_tumbling(const double t)
    {
      return AngularVelocity<3>({0., 0., 1.}) + .7 * std::cos(t) * AngularVelocity<3>({std::cos(t), std::sin(t), 0.});
    }

    /// What is left between the attitude after a time of two, by the two-step formula, and the exact one.
    double error_after(const int n_steps)
    {
      const double dt     = 2. / n_steps;
      Attitude<3>  before = tumbling(0.), now = tumbling(dt);
      for (int step = 2; step <= n_steps; ++step)
      {
        const Bdf2        bdf(dt, dt);
        const Attitude<3> known = turned(now, bdf.before_weight * before.turn_from(now));
        before                  = now;
        now                     = turned(known, bdf.slope_weight * rate_of_tumbling(step * dt));
      }
      EXPECT_NEAR(now.quaternion.norm(), 1., 1e-15);
      return now.turn_from(tumbling(2.)).norm();
    }
  } // namespace

  TEST(Attitude, TurnsByRotationVectorsAndBack)
  {
    const AngularVelocity<3> turn({.3, -1.2, .8});
    const Attitude<3>        first = tumbling(1.3), second = turned(first, turn);
    EXPECT_LE((second.turn_from(first) - turn).norm(), 1e-15);
    EXPECT_LE((first.turn_from(second) + turn).norm(), 1e-15);
    EXPECT_EQ(first.turn_from(first).norm(), 0.);
    const Tensor<2, 3> R = second.rotation();
    EXPECT_LE((R * transpose(R) - unit_symmetric_tensor<3>()).norm(), 1e-15);
    EXPECT_GT(determinant(R), 0.);
  }

  TEST(Attitude, TurnsARotationVectorAsAnAngularVelocityDoes)
  {
    constexpr double         h = 1e-5;
    const AngularVelocity<3> omega({.4, -.9, .2});
    const Tensor<1, 3>       X({.3, .1, -.7});
    const Attitude<3>        at = tumbling(.8);
    const Tensor<1, 3>       difference =
        (turned(at, h * omega).rotation() * X - turned(at, -h * omega).rotation() * X) / (2. * h);
    EXPECT_LE((difference - rotational_velocity<3>(omega, at.rotation() * X)).norm(), h * h);
  }

  // In a plane both are the same, and nothing leaves the plane.
  TEST(Attitude, AboutOneAxisIsThePlanarAngle)
  {
    Attitude<2> planar   = Attitude<2>::about_z(.4);
    Attitude<3> in_space = Attitude<3>::about_z(.4);
    for (int i = 0; i < 100; ++i)
    {
      const double angle = .05 * std::sin(i);
      planar.turn(AngularVelocity<2>({angle}));
      in_space.turn(AngularVelocity<3>({0., 0., angle}));
    }
    EXPECT_NEAR(in_space.heading(), planar.heading(), 1e-14);
    EXPECT_EQ(in_space.quaternion.x(), 0.);
    EXPECT_EQ(in_space.quaternion.y(), 0.);
  }

  TEST(Attitude, TwoStepFormulaIsOfSecondOrderOnRotations)
  {
    const double coarse = error_after(40), fine = error_after(80);
    EXPECT_LT(coarse, 1e-2);
    EXPECT_GT(std::log2(coarse / fine), 1.9);
  }
} // namespace swimtwin
