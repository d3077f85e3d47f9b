#include <fom/resistance/motion_inertia.h>
#include <fom/resistance/motion_resistance.h>

#include <fom/body/mesh_around.h>
#include <fom/resistance/resistance.h>
#include <tests/fom/resistance/tail_motions.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    const std::vector<std::string> coarse_in_space = {"numerics.mesh_size_m=6e-4", "numerics.mesh_size_corner_m=2e-4",
                                                      "numerics.mesh_growth=0.8"};

    /// The swimmer as built, its fluid solved by halves or whole.
    struct SpatialBody
    {
      explicit SpatialBody(const std::string &name, const std::string &half)
          : scene(shipped_scene(name, with(half))), swimmer(scene, MPI_COMM_WORLD)
      {
      }

      static std::vector<std::string> with(const std::string &half)
      {
        auto overrides = coarse_in_space;
        overrides.push_back("numerics.symmetric_half=\"" + half + "\"");
        return overrides;
      }

      NodalField<3> bending(const double amount) const { return bending_of(swimmer, amount); }
      NodalField<3> stretching() const { return stretching_of(swimmer); }

      BodyMotions<3> motions() const { return {{bending(1.)}, {{stretching()}}}; }

      Scene      scene;
      Swimmer<3> swimmer;
    };

    /// Largest difference of entries over the diagonal's.
    double difference(const FullMatrix<double> &A, const FullMatrix<double> &B)
    {
      double largest = 0.;
      for (unsigned int i = 0; i < A.m(); ++i)
        for (unsigned int j = 0; j < A.n(); ++j)
          largest = std::max(largest, std::abs(A(i, j) - B(i, j)) / std::sqrt(A(i, i) * A(j, j)));
      return largest;
    }
  } // namespace

  // At rest the whole mesh is the mirrored half.
  TEST(MotionsInSpace, AreResistedByBothHalvesAsByOneTwice)
  {
    for (const char *name : {"reference-3d-paper", "open-3d"}) // open at its ends, and closed
    {
      const SpatialBody half(name, "on"), whole(name, "off");
      const auto        resist = [](const SpatialBody &body) {
        return compute_motion_resistance(body.swimmer, body.swimmer.configuration_at_rest(),
                                                {body.bending(1.), body.stretching()}, MPI_COMM_WORLD);
      };
      const auto of_half = resist(half), of_whole = resist(whole);
      ASSERT_EQ(of_half.matrix.m(), 5u); // Ux, Uy, omega and the modes
      EXPECT_LT(of_half.asymmetry, 1e-9);
      EXPECT_LT(difference(of_half.matrix, of_whole.matrix), 1e-9) << name;
    }
  }

  TEST(MotionsInSpace, OfABentBodyAreResistedSymmetrically)
  {
    const SpatialBody body("reference-3d-paper", "on");
    auto              c = body.swimmer.configuration_at_rest();
    c.shape             = body.bending(1.);
    c.pose.set_attitude(Attitude<3>::about_z(.4));
    EXPECT_LT(
        compute_motion_resistance(body.swimmer, c, {body.bending(1.), body.stretching()}, MPI_COMM_WORLD).asymmetry,
        1e-9);
  }

  // The mesh made at rest follows both bodies alike.
  TEST(MotionsInSpace, OfABentBodyAreResistedByBothHalvesAsByOneTwice)
  {
    const auto resist = [](const SpatialBody &body) {
      const auto     rest = body.swimmer.configuration_at_rest();
      FluidDomain<3> fluid(body.scene, mesh_for_given_motions(body.swimmer, rest, MPI_COMM_WORLD), rest.pose);
      auto           c = rest;
      c.shape          = body.bending(1.);
      c.pose.set_attitude(Attitude<3>::about_z(.2));
      EXPECT_GT(fluid.follow(body.swimmer.surface(c), c.pose), 0.);
      return compute_motion_resistance(body.swimmer, fluid, c, {body.bending(1.), body.stretching()}).matrix;
    };
    const SpatialBody half("reference-3d-paper", "on"), whole("reference-3d-paper", "off");
    EXPECT_LT(difference(resist(half), resist(whole)), 1e-8);
  }

  TEST(MotionsInSpace, RigidOnesAreTheInverseOfTheMobility)
  {
    const SpatialBody body("reference-3d-paper", "on");
    const auto        rest     = body.swimmer.configuration_at_rest();
    const auto        expected = compute_resistance(body.swimmer, rest, MPI_COMM_WORLD).matrix;
    EXPECT_LT(difference(compute_motion_resistance(body.swimmer, rest, {}, MPI_COMM_WORLD).matrix, expected), 1e-9);
  }

  TEST(MotionsInSpace, CarryTheInertiaOfBothHalves)
  {
    const SpatialBody half("reference-3d-paper", "on"), whole("reference-3d-paper", "off");
    const auto        inertia = [](const SpatialBody &body) {
      const auto           rest = body.swimmer.configuration_at_rest();
      const FluidDomain<3> fluid(body.scene, mesh_for_given_motions(body.swimmer, rest, MPI_COMM_WORLD), rest.pose);
      return compute_fluid_inertia(body.swimmer, fluid, rest, body.motions());
    };
    const auto of_half = inertia(half), of_whole = inertia(whole);
    EXPECT_LT(difference(of_half.mass, of_whole.mass), 1e-9);
    for (unsigned int i = 0; i < of_half.quadratic.size(); ++i)
    {
      FullMatrix<double> left = of_half.quadratic[i];
      left.add(-1., of_whole.quadratic[i]);
      EXPECT_LT(left.linfty_norm(), 1e-6 * of_whole.quadratic[3].linfty_norm()) << i;
    }
  }

  // On one mesh that follows the body the mass is a smooth function of its motion: the differences are exact to second
  // order, and those of the mesh itself are in them.
  TEST(MotionsInSpace, HaveSlopesOfTheMassThatAreItsDifferences)
  {
    const SpatialBody body("reference-3d-paper", "on");
    const auto        rest = body.swimmer.configuration_at_rest();
    FluidDomain<3>    fluid(body.scene, mesh_for_given_motions(body.swimmer, rest, MPI_COMM_WORLD), rest.pose);
    const auto        at = [&](const double bend, const double angle) {
      auto c  = rest;
      c.shape = body.bending(bend);
      c.pose.set_attitude(Attitude<3>::about_z(angle));
      EXPECT_GT(fluid.follow(body.swimmer.surface(c), c.pose), 0.);
      const auto unit = body.bending(1.);
      return compute_fluid_inertia(body.swimmer, fluid, c, {{unit}, {{NodalField<3>(unit.size())}}});
    };
    constexpr double bend = 1., angle = .2, step = .02;
    const auto       here       = at(bend, angle);
    const auto       difference = [&](const MotionInertia<3> &up, const MotionInertia<3> &down, const unsigned int k) {
      double worst = 0.;
      for (unsigned int i = 0; i < here.mass.m(); ++i)
        for (unsigned int j = 0; j < here.mass.n(); ++j)
          worst =
              std::max(worst, std::abs((up.mass(i, j) - down.mass(i, j)) / (2. * step) - here.mass_slopes[k](i, j)) /
                                        std::sqrt(here.mass(i, i) * here.mass(j, j)));
      return worst;
    };
    EXPECT_LT(difference(at(bend + step, angle), at(bend - step, angle), 3), 1e-3);
    EXPECT_LT(difference(at(bend, angle + step), at(bend, angle - step), 2), 1e-3);
  }

  // A rigid body of the tail's mass, whose products of inertia are those of a body of revolution.
  TEST(MotionsInSpace, OfTheTailAloneHaveItsMass)
  {
    const SpatialBody body("reference-3d-paper", "on");
    const auto   of_tail = compute_tail_inertia(body.swimmer, body.swimmer.configuration_at_rest(), body.motions());
    const double volume  = body.swimmer.elasticity().volume();
    EXPECT_NEAR(of_tail.mass(0, 0), volume, 1e-12 * volume);
    EXPECT_NEAR(of_tail.mass(1, 1), volume, 1e-12 * volume);
    EXPECT_NEAR(of_tail.mass(0, 1), 0., 1e-12 * volume);
    EXPECT_NEAR(of_tail.mass(0, 2), 0., 1e-3 * volume * body.scene.tail->length_m);
    EXPECT_GT(of_tail.mass(1, 2), .2 * volume * body.scene.tail->length_m); // the middle lies behind the head
    EXPECT_GT(of_tail.mass(2, 2) * of_tail.mass(1, 1), std::pow(of_tail.mass(1, 2), 2));
  }
} // namespace swimtwin
