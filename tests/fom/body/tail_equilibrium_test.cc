#include <fom/body/tail_equilibrium.h>

#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// Order of the tail's displacement: 1 or 2.
    class TailEquilibriumTest : public ::testing::TestWithParam<int>
    {
    protected:
      Scene scene =
          shipped_scene("reference-2d-casefile", {"numerics.mesh_size_m=5e-4", "numerics.mesh_size_corner_m=1e-4",
                                                  GetParam() == 1 ? "numerics.tail_order=1" : "numerics.tail_order=2"});
      Swimmer<2>    swimmer{scene, MPI_COMM_WORLD};
      const double  length = scene.body_length_m();
      NodalField<2> at_rest{swimmer.tail().mesh.n_nodes()};

      /// Bent by a third of the length; in the tail's space, zero where it is clamped.
      NodalField<2> bent() const
      {
        const auto   &mesh = swimmer.tail().mesh;
        NodalField<2> shape(mesh.n_nodes());
        for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
          if (!swimmer.is_clamped(a))
          {
            const double s = (mesh.nodes[a][0] - scene.head.size_m[0] / 2) / length;
            shape[a]       = Tensor<1, 2>({-0.1 * length * s * s, 0.33 * length * s * s});
          }
        if (GetParam() == 1)
          for (unsigned int e = 0; e < mesh.edges().size(); ++e)
            shape[mesh.n_vertices() + e] = .5 * (shape[mesh.edges()[e][0]] + shape[mesh.edges()[e][1]]);
        return shape;
      }

      NodalField<2> internal_forces(const NodalField<2> &shape) const
      {
        const auto               &mesh = swimmer.tail().mesh;
        NodalField<2>             result(mesh.n_nodes());
        ElasticTail<2>::CellForce force;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          swimmer.elasticity().cell_force(c, shape, force);
          for (unsigned int i = 0; i < force.size(); ++i)
            result[mesh.cells[c][i / 2]][i % 2] += force[i];
        }
        return result;
      }

      double largest_difference(const NodalField<2> &a, const NodalField<2> &b) const
      {
        double largest = 0.;
        for (unsigned int i = 0; i < a.size(); ++i)
          largest = std::max(largest, (a[i] - b[i]).norm());
        return largest;
      }
    };
  } // namespace

  TEST_P(TailEquilibriumTest, FindsTheShapeWhoseForcesItIsGiven)
  {
    TailEquilibrium<2>  tail(swimmer, {}, MPI_COMM_WORLD);
    const NodalField<2> target = bent();
    NodalField<2>       shape  = target;
    for (auto &d : shape)
      d *= 0.9;
    ASSERT_TRUE(tail.solve(internal_forces(target), 1e-12 * length, shape));
    EXPECT_LE(largest_difference(shape, target), 1e-10 * length);
  }

  TEST_P(TailEquilibriumTest, WithoutLoadsIsAtRest)
  {
    TailEquilibrium<2> tail(swimmer, {}, MPI_COMM_WORLD);
    NodalField<2>      shape = at_rest;
    ASSERT_TRUE(tail.solve(at_rest, 1e-12 * length, shape));
    EXPECT_EQ(largest_difference(shape, at_rest), 0.);
  }

  TEST_P(TailEquilibriumTest, SaysWhenThereIsNoEquilibriumItCouldReach)
  {
    TailEquilibrium<2> tail(swimmer, {}, MPI_COMM_WORLD);
    NodalField<2>      loads = internal_forces(bent()), shape = at_rest;
    for (auto &f : loads)
      f *= -1e3;
    EXPECT_FALSE(tail.solve(loads, 1e-12 * length, shape));
  }

  INSTANTIATE_TEST_SUITE_P(Orders, TailEquilibriumTest, ::testing::Values(1, 2),
                           [](const auto &test) { return test.param == 1 ? "Linear" : "Quadratic"; });
} // namespace swimtwin
