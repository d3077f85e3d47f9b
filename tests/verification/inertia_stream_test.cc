// A uniform stream through a mesh that moves, however it moves and whatever is meshed anew: no force, no change.
#include <fom/body/mesh_around.h>
#include <fom/fluid/flow_transfer.h>
#include <tests/fom/bent_swimmer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    using dealii::Tensor;

    const Tensor<1, 2> stream({8e-3, -5e-3}); // m/s

    /// The bent swimmer as it is meshed, then turned, carried on, and bent on twice, by a tenth of its length each
    /// time.
    class StreamThroughMovingMesh : public ::testing::Test
    {
    protected:
      Configuration<2> configuration(const int instant) const
      {
        Configuration<2> c = swimmer_.configuration;
        c.pose.angle += .1 * instant;
        c.pose.center += instant * Tensor<1, 2>({3e-4, -8e-4});
        for (auto &d : c.shape)
          d *= 1. + .3 * instant * instant;
        return c;
      }

      void follow(const int instant)
      {
        const Configuration<2> c = configuration(instant);
        ASSERT_GT(swimmer_.fluid.follow(swimmer_.swimmer.surface(c), c.pose), .05);
      }

      FluidMotion<2> motion(const FluidDomain<2> &fluid, const Tensor<1, 2> &velocity) const
      {
        return {fluid.positions(), std::vector<Tensor<1, 2>>(fluid.mesh().n_nodes(), velocity)};
      }

      /// The mesh's past moves, the fluid's is the stream.
      void stream_until_now()
      {
        FluidPast<2> past;
        past.before = motion(swimmer_.fluid, stream);
        follow(1);
        past.now = motion(swimmer_.fluid, stream);
        swimmer_.fluid.set_past(past);
      }

      /// Values of the fluid's rows: that velocity, no pressure.
      std::vector<double> values(const FluidDomain<2> &fluid, const Tensor<1, 2> &velocity) const
      {
        std::vector<double> rows(fluid.n_rows(), 0.);
        for (unsigned int i = 0; i < fluid.mesh().n_nodes(); ++i)
          for (int c = 0; c < 2; ++c)
            rows[fluid.numbering().vector_index(i, c)] = velocity[c];
        return rows;
      }

      /// Largest entry, relative to rho U^2 L.
      double relative_size(const std::vector<double> &force) const
      {
        double largest = 0.;
        for (const double f : force)
          largest = std::max(largest, std::abs(f));
        return largest / (swimmer_.scene.fluid->density_kg_m3 * stream.norm_square() * swimmer_.scene.body_length_m());
      }

      BentSwimmer swimmer_{{"fluid.inertia=full"}};
      const Bdf2  step_{2e-2, 3e-2}; // s: the mesh is about as fast as the stream
    };
  } // namespace

  TEST_F(StreamThroughMovingMesh, ExertsNoForce)
  {
    FluidDomain<2> &fluid = swimmer_.fluid;
    stream_until_now();
    fluid.begin_step(step_);
    follow(2);
    const FluidReaction reaction = fluid.react(values(fluid, stream));
    std::cout << "uniform stream: forces up to " << relative_size(reaction.force) << " rho U^2 L" << std::endl;
    EXPECT_LE(relative_size(reaction.force), 1e-12);
    // One that is a hundredth faster than before is held: there is something to be seen.
    EXPECT_GT(relative_size(fluid.react(values(fluid, 1.01 * stream)).force), 1e-5);
  }

  TEST_F(StreamThroughMovingMesh, CrossesARemeshing)
  {
    stream_until_now();
    const Configuration<2> c = configuration(1);
    FluidDomain<2>         fresh(swimmer_.scene, mesh_around(swimmer_.swimmer, c, MPI_COMM_WORLD), c.pose);
    fresh.set_past(transfer_past(swimmer_.fluid, fresh));
    fresh.begin_step(step_);
    const Configuration<2> next = configuration(2);
    ASSERT_GT(fresh.follow(swimmer_.swimmer.surface(next), next.pose), .05);
    const FluidReaction reaction = fresh.react(values(fresh, stream));
    std::cout << "uniform stream after remeshing: forces up to " << relative_size(reaction.force) << " rho U^2 L"
              << std::endl;
    EXPECT_LE(relative_size(reaction.force), 1e-12);
  }
} // namespace swimtwin
