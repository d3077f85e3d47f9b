#include <fom/body/mesh_around.h>
#include <fom/fluid/flow_transfer.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <mpi.h>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr double length = 1e-3;

    /// Linear, without divergence: curved cells have it exactly.
    Tensor<1, 2> flow(const Point<2> &x)
    {
      const double a = x[0] / length, b = x[1] / length;
      return Tensor<1, 2>({1. + a + 2. * b, .3 * a - b});
    }

    struct Domains
    {
      Scene                           scene;
      Swimmer<2>                      swimmer{scene, MPI_COMM_WORLD};
      std::unique_ptr<FluidDomain<2>> coarse, fine;

      explicit Domains(const Scene &given) : scene(given)
      {
        const auto make = [&](const double far_size) {
          scene.numerics.mesh_size_far_m = far_size;
          const auto rest                = swimmer.configuration_at_rest();
          return std::make_unique<FluidDomain<2>>(scene, mesh_around(swimmer, rest, MPI_COMM_WORLD), rest.pose);
        };
        coarse = make(2e-3);
        fine   = make(1e-3);
      }
    };

    Scene scene_with_inertia()
    {
      return shipped_scene("reference-2d-paper", {"fluid.inertia=full", "numerics.symmetric_half=off"});
    }

    void fill(FluidMotion<2> &motion)
    {
      for (unsigned int i = 0; i < motion.positions.size(); ++i)
        motion.velocity[i] = flow(motion.positions[i]);
    }
  } // namespace

  // What both meshes can represent arrives, with the way that the mesh came.
  TEST(FlowTransfer, KeepsALinearFlow)
  {
    const Domains domains(scene_with_inertia());
    FluidPast<2>  past = domains.coarse->past();
    fill(past.now);
    past.before = past.now;
    const Tensor<1, 2> way({1e-5, -2e-5});
    for (auto &x : past.before.positions)
      x -= way;
    domains.coarse->set_past(past);
    const FluidPast<2> arrived = transfer_past(*domains.coarse, *domains.fine);
    ASSERT_EQ(arrived.now.positions.size(), domains.fine->mesh().n_nodes());
    double fastest = 0.;
    for (const auto &u : past.now.velocity)
      fastest = std::max(fastest, u.norm());
    for (unsigned int i = 0; i < arrived.now.positions.size(); ++i)
    {
      const double tolerance = 1e-10 * fastest;
      EXPECT_LT((arrived.now.velocity[i] - flow(arrived.now.positions[i])).norm(), tolerance);
      EXPECT_LT((arrived.before.velocity[i] - flow(arrived.now.positions[i])).norm(), tolerance);
      EXPECT_LT((arrived.now.positions[i] - arrived.before.positions[i] - way).norm(), 1e-14);
    }
  }

  // A flow with divergence loses it, keeps its values at body and walls, and does not change a second time.
  TEST(FlowTransfer, TakesOffTheDivergence)
  {
    const Domains  domains(scene_with_inertia());
    FluidMotion<2> motion = domains.fine->past().now;
    for (unsigned int i = 0; i < motion.positions.size(); ++i)
      motion.velocity[i] = flow(motion.positions[i]) + Tensor<1, 2>({.1 * motion.positions[i][0] / length, 0.});
    const FluidMotion<2> given = motion;
    remove_divergence(*domains.fine, motion);
    for (const auto node : domains.fine->fluid_mesh().surface_nodes)
      EXPECT_EQ((motion.velocity[node] - given.velocity[node]).norm(), 0.);
    FluidMotion<2> again = motion;
    remove_divergence(*domains.fine, again);
    double change = 0., size = 0.;
    for (unsigned int i = 0; i < motion.positions.size(); ++i)
    {
      change = std::max(change, (again.velocity[i] - motion.velocity[i]).norm());
      size   = std::max(size, (motion.velocity[i] - given.velocity[i]).norm());
    }
    EXPECT_GT(size, 1e-2);
    EXPECT_LT(change, 1e-9 * size);
  }
} // namespace swimtwin
