#include <fom/body/swimmer.h>

#include <fom/geometry/reflection.h>
#include <fom/mesh/swimmer_outline.h>
#include <tests/fom/random_tensors.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    const std::vector<std::string> coarse_body = {"numerics.mesh_size_m=5e-4", "numerics.mesh_size_corner_m=1e-4"};

    class SwimmerTest : public ::testing::Test
    {
    protected:
      Scene         scene = shipped_scene("reference-2d-casefile", coarse_body);
      Swimmer<2>    swimmer{scene, MPI_COMM_WORLD};
      const double  length = scene.body_length_m();
      RandomNumbers random;

      /// A motion that is quadratic in time: configuration and rates at t.
      Configuration<2> configuration(const double t) const
      {
        Configuration<2> c = swimmer.configuration_at_rest();
        c.pose.center += Tensor<1, 2>({1e-3 * t, 2e-3 * t * t});
        c.pose.angle = 0.4 + 0.7 * t - 0.3 * t * t;
        for (unsigned int a = 0; a < c.shape.size(); ++a)
        {
          const auto &X = swimmer.tail().mesh.nodes[a];
          c.shape[a]    = Tensor<1, 2>({-3. * t * t * X[0] * X[0], 20. * (t - t * t) * X[0] * X[0]});
        }
        return c;
      }
      Rates<2> rates(const double t) const
      {
        Rates<2> r{Tensor<1, 2>({1e-3, 4e-3 * t}), AngularVelocity<2>({0.7 - 0.6 * t}), {}};
        for (const auto &X : swimmer.tail().mesh.nodes)
          r.shape_rate.push_back(Tensor<1, 2>({-6. * t * X[0] * X[0], 20. * (1. - 2. * t) * X[0] * X[0]}));
        return r;
      }
    };
  } // namespace

  const Tensor<1, 2> along_x({1., 0.});

  // Torque is minus the derivative of -m . B; a central difference of a sine, h^2 / 6 off.
  TEST(MagneticTorque, IsTheDerivativeOfTheEnergy)
  {
    constexpr double            moment = 3., h = 1e-4;
    const std::array<double, 3> field  = {0.3, -0.8, 0.};
    const auto                  energy = [&](const double angle) {
      return -moment * (std::cos(angle) * field[0] + std::sin(angle) * field[1]);
    };
    for (const double angle : {-2., 0., 0.5, 3.})
    {
      const auto torque = [&](const double at) { return magnetic_torque<2>(moment, along_x, {at}, field).torque[0]; };
      EXPECT_NEAR(torque(angle), -(energy(angle + h) - energy(angle - h)) / (2. * h), moment * h * h);
      EXPECT_NEAR((magnetic_torque<2>(moment, along_x, {angle}, field).derivative[0][0]),
                  (torque(angle + h) - torque(angle - h)) / (2. * h), moment * h * h);
    }
  }

  TEST_F(SwimmerTest, TorqueOnTheHeadIsMagnetizationTimesAreaTimesField)
  {
    const double quarter = scene.time.period_s / 4.; // the field is (5, 5) mT there
    EXPECT_NEAR(swimmer.torque_on_head({0.}, quarter).torque[0], 2e5 * 0.5e-3 * 1.5e-3 * 5e-3, 1e-16);
    EXPECT_NEAR(swimmer.torque_on_head({std::numbers::pi / 4.}, quarter).torque[0], 0., 1e-16);
  }

  TEST_F(SwimmerTest, TailAngleOfARigidTurnIsTheHeadsAngle)
  {
    Configuration<2> c = swimmer.configuration_at_rest();
    EXPECT_NEAR(swimmer.tail_angle(c), 0., 1e-14);
    c.pose.angle = 0.9;
    EXPECT_NEAR(swimmer.tail_angle(c), 0.9, 1e-14);
  }

  // A parabola is a quadratic of the last edge too, so its slope at the tip is found exactly.
  TEST_F(SwimmerTest, TailAngleIsTheTangentAtTheTip)
  {
    Configuration<2> c = swimmer.configuration_at_rest();
    c.pose.angle       = -0.2;
    for (unsigned int a = 0; a < c.shape.size(); ++a)
    {
      const double x = swimmer.tail().mesh.nodes[a][0];
      c.shape[a][1]  = 40. * x * x;
    }
    EXPECT_NEAR(swimmer.tail_angle(c), -0.2 + std::atan(80. * 7.75e-3),
                1e-10); // positions of 1e-3 m over an edge of 1e-4 m
  }

  // Central differences of a smooth motion: off by h^2 / 6 of its third derivative, a few body lengths per second
  // cubed.
  TEST_F(SwimmerTest, VelocitiesAreTheDerivativeOfPositions)
  {
    constexpr double t = 0.3, h = 1e-4;
    const auto       w     = swimmer.tail_velocities(configuration(t), rates(t));
    const auto       after = swimmer.tail_positions(configuration(t + h)),
               before      = swimmer.tail_positions(configuration(t - h));
    for (unsigned int a = 0; a < w.size(); ++a)
      EXPECT_LE((w[a] - (after[a] - before[a]) / (2. * h)).norm(), 10. * h * h * length);

    const auto surface_after  = swimmer.surface(configuration(t + h)),
               surface_before = swimmer.surface(configuration(t - h));
    for (unsigned int k = 0; k < swimmer.n_surface_nodes(); ++k)
    {
      const Tensor<1, 2> found = (surface_after[k] - surface_before[k]) / (2. * h);
      const int          node  = swimmer.tail_node(k);
      const auto         c     = configuration(t);
      const Tensor<1, 2> expected =
          node >= 0 ? w[node]
                    : rates(t).velocity +
                          rotational_velocity<2>(rates(t).omega, c.pose.rotation() * swimmer.surface_at_rest(k));
      EXPECT_LE((found - expected).norm(), 10. * h * h * length);
    }
  }

  TEST_F(SwimmerTest, SurfaceAndTailShareTheirNodes)
  {
    const auto   c       = configuration(0.3);
    const auto   surface = swimmer.surface(c), tail = swimmer.tail_positions(c);
    unsigned int n_shared = 0;
    for (unsigned int k = 0; k < surface.size(); ++k)
      if (swimmer.tail_node(k) >= 0)
      {
        ++n_shared;
        EXPECT_LE(surface[k].distance(tail[swimmer.tail_node(k)]), 1e-17);
      }
    EXPECT_EQ(n_shared, swimmer.tail().surface_nodes.size());
  }

  TEST_F(SwimmerTest, TailMeshHasExactParity)
  {
    const auto &nodes = swimmer.tail().mesh.nodes;
    for (const auto &x : nodes)
    {
      double nearest = 1.;
      for (const auto &y : nodes)
        nearest = std::min(nearest, y.distance(mirrored(x)));
      EXPECT_LE(nearest, 1e-18);
    }
  }

  TEST_F(SwimmerTest, ClampedNodesAreOnTheHead)
  {
    for (unsigned int a = 0; a < swimmer.tail().mesh.n_nodes(); ++a)
      EXPECT_EQ(swimmer.is_clamped(a), std::abs(swimmer.tail().mesh.nodes[a][0] - 0.25e-3) < 1e-12) << a;
  }

  TEST_F(SwimmerTest, RelativeChangeMeasuresMotionInBodyLengths)
  {
    const auto c = configuration(0.3);
    auto       d = c;
    EXPECT_EQ(swimmer.relative_change(c, c), 0.);
    d.pose.center += Tensor<1, 2>({3e-3, 4e-3});
    EXPECT_NEAR(swimmer.relative_change(c, d), 5e-3 / length, 1e-12);
    // A head that turns alone (the tail follows): at least the change of the rotation, 2 sin(angle / 2).
    d = c;
    d.pose.angle += 0.1;
    EXPECT_GE(swimmer.relative_change(c, d), 2. * std::sin(0.05) - 1e-12);
  }

  TEST(SwimmerLoads, WeightIsThatOfTheDisplacedFluidLess)
  {
    auto overrides = coarse_body;
    overrides.insert(overrides.end(), {"gravity.acceleration_m_s2=[0.0, -9.81]", "gravity.ramp_s=2.0"});
    const Scene      scene = shipped_scene("reference-2d-casefile", overrides);
    const Swimmer<2> swimmer(scene, MPI_COMM_WORLD);
    Tensor<1, 2>     weight;
    for (unsigned int a = 0; a < swimmer.tail().mesh.n_nodes(); ++a)
      weight += swimmer.load_on_tail_node(a, 10.);
    const double expected = (1260. - 1200.) * 9.81 * swimmer.elasticity().volume(); // lighter than glycerol: it floats
    EXPECT_NEAR(weight[0], 0., 1e-12 * expected);
    EXPECT_NEAR(weight[1], expected, 1e-12 * expected);
    EXPECT_NEAR(swimmer.force_on_head(10.)[1], -(7000. - 1260.) * 9.81 * 0.75e-6, 1e-12);
    EXPECT_NEAR(swimmer.force_on_head(0.5)[1], 0.25 * swimmer.force_on_head(10.)[1], 1e-15); // ramp
  }

  // Dead loads of a magnetised tail: no force, and about any point the torque of its moment, as for a head.
  TEST(SwimmerLoads, MagnetisedTailFeelsTheTorqueOfItsMoment)
  {
    auto overrides = coarse_body;
    overrides.push_back("tail.magnetization_A_m=3e4");
    const Scene      scene = shipped_scene("reference-2d-casefile", overrides);
    const Swimmer<2> swimmer(scene, MPI_COMM_WORLD);
    Configuration<2> c = swimmer.configuration_at_rest();
    c.pose.angle       = 0.6;
    const double t     = 0.1;
    const auto   x     = swimmer.tail_positions(c);
    Tensor<1, 2> force;
    double       torque = 0., magnitude = 0.;
    for (unsigned int a = 0; a < x.size(); ++a)
    {
      const auto f = swimmer.load_on_tail_node(a, t);
      force += f;
      magnitude += f.norm();
      torque += x[a][0] * f[1] - x[a][1] * f[0];
    }
    const double expected =
        magnetic_torque<2>(3e4 * swimmer.elasticity().volume(), along_x, {0.6}, scene.field(t)).torque[0];
    EXPECT_LE(force.norm(), 1e-12 * magnitude);
    EXPECT_NEAR(torque, expected, 1e-11 * std::abs(expected));
  }

  // The area is quadratic in the positions, these are cubic in time: a central difference is h^2 off.
  TEST_F(SwimmerTest, AreaRateIsTheDerivativeOfTheArea)
  {
    constexpr double t = 0.3, h = 1e-4;
    const double difference = (swimmer.volume(configuration(t + h)) - swimmer.volume(configuration(t - h))) / (2. * h);
    const double rate       = swimmer.volume_rate(configuration(t), rates(t));
    EXPECT_GT(std::abs(rate), 1e-3 * swimmer.volume(configuration(t)));
    EXPECT_NEAR(rate, difference, 1e-6 * std::abs(rate));
  }

  // Head, taper from 1.5 to 0.2 mm over 7.4 mm, half circle; a coarse_body polygon of quadratic edges follows it
  // closely.
  TEST_F(SwimmerTest, AreaAtRestIsThatOfItsParts)
  {
    const double exact = 0.5e-3 * 1.5e-3 + 7.4e-3 * (1.5e-3 + 0.2e-3) / 2. + std::numbers::pi * 0.1e-3 * 0.1e-3 / 2.;
    EXPECT_NEAR(swimmer.volume(swimmer.configuration_at_rest()), exact, 1e-5 * exact);
  }

  // Both are sums over the same nodes: round-off of millimetres.
  TEST_F(SwimmerTest, ArmToTheMiddleEndsInTheMeanOfTheSurface)
  {
    const auto   c       = configuration(0.3);
    const auto   surface = swimmer.surface(c), at_rest = swimmer.surface(swimmer.configuration_at_rest());
    Tensor<1, 2> mean;
    double       total = 0.;
    for (unsigned int p = 0; p < surface.size(); p += 2)
    {
      const unsigned int q    = (p + 2) % surface.size();
      const double       edge = at_rest[p].distance(at_rest[q]);
      mean += edge / 6. * (Tensor<1, 2>(surface[p]) + 4. * Tensor<1, 2>(surface[p + 1]) + Tensor<1, 2>(surface[q]));
      total += edge;
    }
    EXPECT_LE((c.pose.to_laboratory(swimmer.arm_to_middle(c.shape)) - Point<2>(mean / total)).norm(), 1e-12 * length);
    EXPECT_NEAR(swimmer.arm_to_middle(swimmer.configuration_at_rest().shape)[1], 0., 1e-12 * length);
  }

  // A central difference is exact for a motion quadratic in time.
  TEST_F(SwimmerTest, RateOfTheArmIsItsDerivative)
  {
    constexpr double t = 0.3, h = 1e-2;
    const auto       difference =
        swimmer.arm_to_middle(configuration(t + h).shape) - swimmer.arm_to_middle(configuration(t - h).shape);
    EXPECT_LE((swimmer.rate_of_arm(rates(t).shape_rate) - difference / (2. * h)).norm(), 1e-12 * length / h);
  }

  TEST_F(SwimmerTest, MiddleOfAFixedHeadIsItsCentre)
  {
    const Scene fixed_scene =
        shipped_scene("reference-2d-casefile", {coarse_body[0], coarse_body[1], "head.motion=fixed"});
    const Swimmer<2> fixed(fixed_scene, MPI_COMM_WORLD);
    EXPECT_EQ(fixed.arm_to_middle(configuration(0.3).shape).norm(), 0.);
  }

  // Of -m . B along rotation vectors.
  TEST(MagneticTorque, InSpaceIsTheFirstDerivativeOfTheEnergyAndHasTheSecond)
  {
    constexpr double            moment = 3., h = 1e-3;
    const std::array<double, 3> field = {0.3, -0.8, 0.5};
    Attitude<3>                 attitude;
    attitude.turn(AngularVelocity<3>({.4, -1.1, .7}));
    const AngularVelocity<3> directions[] = {AngularVelocity<3>({1., 0., 0.}), AngularVelocity<3>({0.6, 0., -0.8}),
                                             AngularVelocity<3>({-.3, .5, .2})};
    for (const Tensor<1, 3> &direction :
         {Tensor<1, 3>({1., 0., 0.}), Tensor<1, 3>({0., 1., 0.}), Tensor<1, 3>({.36, -.48, .8})})
    {
      const auto [torque, derivative, axis] = magnetic_torque<3>(moment, direction, attitude, field);
      const auto energy                     = [&](const AngularVelocity<3> &v, const double s) {
        Attitude<3> at = attitude;
        at.turn(s * v);
        return -moment * (at.rotation() * direction * Tensor<1, 3>({field[0], field[1], field[2]}));
      };
      for (const auto &v : directions)
      {
        EXPECT_NEAR(torque * v, -(energy(v, h) - energy(v, -h)) / (2. * h), moment * h * h);
        EXPECT_NEAR(v * (derivative * v), -(energy(v, h) - 2. * energy(v, 0.) + energy(v, -h)) / (h * h),
                    moment * h * h);
      }
      EXPECT_LE((derivative - transpose(derivative)).norm(), 1e-15);
      EXPECT_NEAR(axis * torque, torque.norm(), 1e-15);
    }
  }

  // A field along the moment turns nothing; what it may turn it about is across the moment.
  TEST(MagneticTorque, InSpaceHasAnAxisWhereThereIsNone)
  {
    const Attitude<3> attitude;
    for (const Tensor<1, 3> &direction :
         {Tensor<1, 3>({1., 0., 0.}), Tensor<1, 3>({0., 0., 1.}), Tensor<1, 3>({.36, -.48, .8})})
    {
      const auto result = magnetic_torque<3>(0., direction, attitude, {direction[0], direction[1], direction[2]});
      EXPECT_EQ(result.torque.norm(), 0.);
      EXPECT_NEAR(result.axis * direction, 0., 1e-15);
      EXPECT_NEAR(result.axis.norm(), 1., 1e-15);
    }
  }

  // A turned cylinder: int rho |omega x r|^2 / 2, the middle of each ring by the midpoint rule.
  TEST(SwimmerInSpace, SpinAndEnergyAreThoseOfARotatingCylinder)
  {
    const Scene scene = shipped_scene(
        "rotating-sphere-3d",
        {"variant=quick", "fluid.inertia=full",
         "head={shape=\"cylinder\", size_m=[0.5e-3, 1.5e-3], density_kg_m3=7000.0, magnetization_A_m=1e4}"});
    const Swimmer<3> swimmer(scene, MPI_COMM_WORLD);
    auto             configuration = swimmer.configuration_at_rest();
    configuration.pose.turn(AngularVelocity<3>({.4, -1.1, .7}));
    Rates<3> rates;
    rates.omega              = AngularVelocity<3>({2., 3., -1.});
    const auto    velocities = swimmer.velocities(configuration, rates);
    constexpr int n = 200, n_angles = 16;
    const double  length = .5e-3, radius = .75e-3, pi = std::numbers::pi;
    Tensor<1, 3>  momentum;
    double        energy = 0.;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n_angles; ++k)
        {
          const double       x = length * ((i + .5) / n - .5), r = radius * (j + .5) / n, phi = 2. * pi * k / n_angles;
          const Tensor<1, 3> at =
              configuration.pose.rotation() * Tensor<1, 3>({x, r * std::cos(phi), r * std::sin(phi)});
          const Tensor<1, 3> v    = rotational_velocity<3>(rates.omega, at);
          const double       mass = 7000. * (length / n) * (radius / n) * r * 2. * pi / n_angles;
          momentum += mass * torque_of_force<3>(at, v);
          energy += .5 * mass * v.norm_square();
        }
    EXPECT_LE((swimmer.head_moment_of_inertia() * velocities.spin - momentum).norm(), 1e-4 * momentum.norm());
    EXPECT_NEAR(swimmer.kinetic_energy(velocities), energy, 1e-4 * energy);
  }
} // namespace swimtwin
