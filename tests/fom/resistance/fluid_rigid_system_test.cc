#include <fom/resistance/fluid_rigid_system.h>

#include <tests/fom/bent_swimmer.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    class FluidRigidSystemTest : public ::testing::Test
    {
    protected:
      BentSwimmer          bent;
      const Scene         &scene         = bent.scene;
      const Swimmer<2>    &swimmer       = bent.swimmer;
      Configuration<2>    &configuration = bent.configuration;
      FluidDomain<2>      &fluid         = bent.fluid;
      LinearSystem         solver{MPI_COMM_WORLD, {.tolerance = 1e-13}};
      FluidRigidSystem<2>  system{swimmer, fluid, solver, true, MPI_COMM_WORLD};
      const NodalField<2> &shape_rate = bent.rates.shape_rate;
    };
  } // namespace

  TEST_F(FluidRigidSystemTest, SurfaceMovesWithRigidMotionAndShapeRate)
  {
    system.assemble(configuration, shape_rate, 0.);
    std::vector<double> unknowns(system.n_unknowns(), 0.);
    ASSERT_TRUE(system.solve(unknowns));
    const auto     rigid  = system.rigid_velocity(unknowns);
    const auto     values = system.fluid_values(unknowns);
    const Rates<2> rates{Tensor<1, 2>({rigid[0], rigid[1]}), AngularVelocity<2>({rigid[2]}), shape_rate};
    const auto     w       = swimmer.tail_velocities(configuration, rates);
    double         largest = 0., error = 0.;
    for (unsigned int k = 0; k < swimmer.n_surface_nodes(); ++k)
      if (const int node = swimmer.tail_node(k); node >= 0)
        for (int c = 0; c < 2; ++c)
        {
          largest = std::max(largest, std::abs(w[node][c]));
          error   = std::max(error, std::abs(values[fluid.surface_row(k, c)] - w[node][c]));
        }
    EXPECT_GT(largest, 1e-4);
    EXPECT_LE(error, 1e-12 * largest);
  }

  // The head's rows of P^T A P are the balance of the whole body.
  TEST_F(FluidRigidSystemTest, FluidCarriesTheLoadWhateverTheShapeRate)
  {
    const Tensor<1, 3> load({2e-3, -1e-3, 3e-6});
    system.assemble(configuration, shape_rate, 0.);
    system.add_load(load);
    std::vector<double> unknowns(system.n_unknowns(), 0.);
    ASSERT_TRUE(system.solve(unknowns));
    const auto   on_fluid = fluid.force_on_fluid_at_surface(system.fluid_values(unknowns));
    const auto   x        = swimmer.surface(configuration);
    Tensor<1, 3> sum;
    for (unsigned int k = 0; k < x.size(); ++k)
    {
      const double fx = on_fluid[fluid.surface_row(k, 0)], fy = on_fluid[fluid.surface_row(k, 1)];
      const auto   r = x[k] - configuration.pose.center;
      sum += Tensor<1, 3>({fx, fy, r[0] * fy - r[1] * fx});
    }
    EXPECT_NEAR(sum[0], load[0], 1e-10 * load.norm());
    EXPECT_NEAR(sum[1], load[1], 1e-10 * load.norm());
    EXPECT_NEAR(sum[2], load[2], 1e-10 * load.norm() * scene.body_length_m());
  }

  TEST_F(FluidRigidSystemTest, ForceAtTheSurfaceIsThatOfTheWholeReaction)
  {
    system.assemble(configuration, shape_rate, 0.);
    std::vector<double> unknowns(system.n_unknowns(), 0.);
    ASSERT_TRUE(system.solve(unknowns));
    const auto values = system.fluid_values(unknowns);
    const auto all = fluid.react(values).force, surface = fluid.force_on_fluid_at_surface(values);
    for (unsigned int k = 0; k < swimmer.n_surface_nodes(); ++k)
      for (int c = 0; c < 2; ++c)
        EXPECT_EQ(all[fluid.surface_row(k, c)], surface[fluid.surface_row(k, c)]);
  }
} // namespace swimtwin
