#include <fom/resistance/motion_resistance.h>

#include <fom/resistance/fluid_rigid_system.h>
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

    const std::vector<std::string> coarse_motions = {"numerics.mesh_size_m=6e-4", "numerics.mesh_size_corner_m=2e-4",
                                                     "numerics.mesh_size_far_m=4e-3", "numerics.mesh_growth=0.5"};

    /// The reference swimmer, turned, with its tail bent, and its fluid meshed around it.
    class MotionResistanceTest : public ::testing::Test
    {
    protected:
      Scene            scene = shipped_scene("reference-2d-casefile", coarse_motions);
      Swimmer<2>       swimmer{scene, MPI_COMM_WORLD};
      Configuration<2> configuration = bent();

      Configuration<2> bent() const
      {
        Configuration<2> c = swimmer.configuration_at_rest();
        c.pose.angle       = 0.4;
        c.shape            = bending(1.);
        return c;
      }

      NodalField<2> bending(const double amount) const { return bending_of(swimmer, amount); }
      NodalField<2> stretching() const { return stretching_of(swimmer); }
    };
  } // namespace

  // The same matrix from the other side: unit forces on a free body, instead of unit velocities of a held one.
  TEST_F(MotionResistanceTest, RigidBlockIsTheInverseOfTheMobility)
  {
    const auto R        = compute_motion_resistance(swimmer, configuration, {}, MPI_COMM_WORLD).matrix;
    const auto expected = compute_resistance(swimmer, configuration, MPI_COMM_WORLD).matrix;
    const auto Q        = configuration.pose.rotation();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
      {
        double turned = 0.; // into the head's frame
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            turned += (k < 2 && i < 2 ? Q[k][i] : double(k == i)) * expected(k, l) *
                      (l < 2 && j < 2 ? Q[l][j] : double(l == j));
        EXPECT_NEAR(R(i, j), turned, 1e-9 * std::sqrt(R(i, i) * R(j, j)));
      }
  }

  TEST_F(MotionResistanceTest, IsSymmetricBeforeItIsMadeSo)
  {
    EXPECT_LT(compute_motion_resistance(swimmer, configuration, {bending(1.), stretching()}, MPI_COMM_WORLD).asymmetry,
              1e-9);
  }

  // A force-free body that changes its shape moves as the fluid's own system says.
  TEST_F(MotionResistanceTest, GivesTheMotionOfAForceFreeBody)
  {
    FluidDomain<2>      fluid(scene,
                              make_fluid_mesh(*scene.domain, swimmer.surface(configuration), swimmer.surface_mesh_size(),
                                              configuration.pose, swimmer.pose_at_rest(), scene.numerics, MPI_COMM_WORLD),
                              configuration.pose);
    LinearSolverOptions options;
    options.tolerance = 1e-13;
    LinearSystem        solver(MPI_COMM_WORLD, options);
    FluidRigidSystem<2> system(swimmer, fluid, solver, true, MPI_COMM_WORLD);
    system.assemble(configuration, bending(1.), 0.);
    std::vector<double> unknowns(system.n_unknowns(), 0.);
    ASSERT_TRUE(system.solve(unknowns));
    const auto expected = system.rigid_velocity(unknowns);

    const auto         R = compute_motion_resistance(swimmer, fluid, configuration, {bending(1.)}).matrix;
    FullMatrix<double> rigid(3, 3);
    Vector<double>     load(3), velocity(3);
    for (int i = 0; i < 3; ++i)
    {
      load(i) = -R(i, 3);
      for (int j = 0; j < 3; ++j)
        rigid(i, j) = R(i, j);
    }
    rigid.gauss_jordan();
    rigid.vmult(velocity, load);
    const Tensor<1, 2> U = configuration.pose.rotation() * Tensor<1, 2>({velocity(0), velocity(1)});
    EXPECT_NEAR(U[0], expected[0], 1e-9 * std::abs(expected[1]));
    EXPECT_NEAR(U[1], expected[1], 1e-9 * std::abs(expected[1]));
    EXPECT_NEAR(velocity(2), expected[2], 1e-9 * std::abs(expected[2]));
  }

  // Power balance of a reconstructed flow: what it dissipates is what the resistance says, and it sticks to the body.
  TEST_F(MotionResistanceTest, FlowDissipatesWhatTheResistanceSays)
  {
    const FluidDomain<2> fluid(scene,
                               make_fluid_mesh(*scene.domain, swimmer.surface(configuration),
                                               swimmer.surface_mesh_size(), configuration.pose, swimmer.pose_at_rest(),
                                               scene.numerics, MPI_COMM_WORLD),
                               configuration.pose);
    const Tensor<1, 3>   xi({2e-4, -1e-4, 0.3}); // in the head's frame
    Rates<2>             rates;
    rates.velocity   = configuration.pose.rotation() * Tensor<1, 2>({xi[0], xi[1]});
    rates.omega[0]   = xi[2];
    rates.shape_rate = bending(0.1);
    const auto flow  = compute_flow(swimmer, fluid, configuration, rates);
    const auto R     = compute_motion_resistance(swimmer, fluid, configuration, {bending(0.1)}).matrix;
    double     power = 0.;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        power += (i < 3 ? xi[i] : 1.) * R(i, j) * (j < 3 ? xi[j] : 1.);
    EXPECT_NEAR(fluid.react(flow).dissipation, power, 1e-9 * power);
    const auto tail_velocity = swimmer.tail_velocities(configuration, rates);
    for (unsigned int k = 0; k < swimmer.n_surface_nodes(); ++k)
      for (int c = 0; c < 2 && swimmer.tail_node(k) >= 0; ++c)
        EXPECT_NEAR(flow[fluid.surface_row(k, c)], tail_velocity[swimmer.tail_node(k)][c], 1e-15);
  }

  // Where walls close the domain, a growing body's area goes into the fluid: the problem stays solvable and symmetric.
  TEST_F(MotionResistanceTest, AClosedDomainTakesUpAGrowingBody)
  {
    const Scene      closed = shipped_scene("open-2d", coarse_motions);
    const Swimmer<2> body(closed, MPI_COMM_WORLD);
    const auto       result =
        compute_motion_resistance(body, body.configuration_at_rest(), {bending(1.), stretching()}, MPI_COMM_WORLD);
    EXPECT_LT(result.asymmetry, 1e-9);
    EXPECT_GT(result.matrix(4, 4), 0.);
  }
} // namespace swimtwin
