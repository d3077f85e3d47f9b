#include <fom/fluid_rigid_system.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// The reference swimmer, turned, with its tail bent, and its fluid meshed around it.
    class FluidRigidSystemTest : public ::testing::Test
    {
    protected:
      Scene scene =
          shipped_scene("reference-2d-casefile", {"numerics.mesh_size_m=6e-4", "numerics.mesh_size_corner_m=2e-4",
                                                  "numerics.mesh_size_far_m=4e-3", "numerics.mesh_growth=0.5"});
      Swimmer<2>          swimmer{scene, MPI_COMM_WORLD};
      Configuration<2>    configuration = bent();
      FluidDomain<2>      fluid{scene,
                           make_fluid_mesh(*scene.domain, swimmer.surface(configuration), swimmer.surface_mesh_size(),
                                                configuration.pose, swimmer.pose_at_rest(), scene.numerics, MPI_COMM_WORLD),
                           configuration.pose};
      LinearSystem        solver{MPI_COMM_WORLD, tight()};
      FluidRigidSystem<2> system{swimmer, fluid, solver, true, MPI_COMM_WORLD};
      NodalField<2>       shape_rate = bending_rate();

      static LinearSolverOptions tight()
      {
        LinearSolverOptions options;
        options.tolerance = 1e-13;
        return options;
      }

      Configuration<2> bent() const
      {
        Configuration<2> c = swimmer.configuration_at_rest();
        c.pose.angle       = 0.4;
        for (unsigned int a = 0; a < c.shape.size(); ++a)
          if (!swimmer.is_clamped(a))
            c.shape[a][1] = 10. * std::pow(swimmer.tail().mesh.nodes[a][0] - scene.head.size_m[0] / 2, 2);
        return c;
      }

      NodalField<2> bending_rate() const
      {
        NodalField<2> rate = configuration.shape;
        for (auto &v : rate)
          v *= 5.;
        return rate;
      }
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
