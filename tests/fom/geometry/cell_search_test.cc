#include <fom/body/mesh_around.h>
#include <fom/geometry/cell_search.h>
#include <tests/fom/shipped_scene.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <gtest/gtest.h>

#include <mpi.h>

namespace swimtwin
{
  using namespace dealii;

  // Any reference point of any cell is found again, curved cells at the body's round tip included. (deal.II 9.4.1's own
  // search returns wrong cells on such meshes without a word.)
  TEST(CellSearch, FindsEveryPointOfACurvedMesh)
  {
    const Scene                 scene = shipped_scene("passive-tail-channel");
    const Swimmer<2>            swimmer(scene, MPI_COMM_WORLD);
    const FluidMesh<2>          fluid = mesh_around(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
    const auto                 &mesh  = fluid.mesh;
    const CellSearch<2>         search(mesh, mesh.nodes);
    const FE_SimplexP<2>        quadratic(2);
    const std::vector<Point<2>> references{{.3, .3}, {.1, .8}, {.01, .02}, {.5, .5}, {0., 0.}, {.4, 0.}};
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (const auto &reference : references)
      {
        Point<2> x;
        for (unsigned int a = 0; a < 6; ++a)
          x += quadratic.shape_value(a, reference) * mesh.nodes[mesh.cells[c][a]];
        const auto found = search.find(x);
        ASSERT_TRUE(found);
        EXPECT_LT(found->outside, 1e-9);
        EXPECT_LT(found->interpolate(mesh.cells[found->cell], mesh.nodes).distance(x), 1e-14);
      }
  }

  TEST(CellSearch, FindsNothingInsideTheBodyOrBeyondTheWalls)
  {
    const Scene         scene = shipped_scene("passive-tail-channel");
    const Swimmer<2>    swimmer(scene, MPI_COMM_WORLD);
    const FluidMesh<2>  fluid = mesh_around(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
    const CellSearch<2> search(fluid.mesh, fluid.mesh.nodes);
    EXPECT_FALSE(search.find(Point<2>(0., 1e-3)));  // the head's centre
    EXPECT_FALSE(search.find(Point<2>(0., 50e-3))); // beyond the wall
  }
} // namespace swimtwin
