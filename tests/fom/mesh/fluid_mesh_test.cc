#include <fom/mesh/fluid_mesh.h>

#include <fom/body/swimmer.h>
#include <fom/geometry/isoparametric_cell.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;
    using std::numbers::pi;

    const std::vector<std::string> coarse_mesh = {"numerics.mesh_size_m=4e-4", "numerics.mesh_size_corner_m=1e-4"};

    struct MeshedScene
    {
      Scene        scene;
      Swimmer<2>   swimmer{scene, MPI_COMM_WORLD};
      FluidMesh<2> fluid =
          make_fluid_mesh(*scene.domain, swimmer.surface(swimmer.configuration_at_rest()), swimmer.surface_mesh_size(),
                          swimmer.pose_at_rest(), swimmer.pose_at_rest(), scene.numerics, MPI_COMM_WORLD);

      explicit MeshedScene(Scene s) : scene(std::move(s)) {}

      double area() const
      {
        IsoparametricCell<2> cell;
        double               sum = 0.;
        for (const auto &nodes : fluid.mesh.cells)
        {
          cell.reinit(cell_positions<2>(nodes, fluid.mesh.nodes));
          for (unsigned int q = 0; q < cell.n_points(); ++q)
            sum += cell.weight(q);
        }
        return sum;
      }
      const WallNode &wall_node_at(const Point<2> &x) const
      {
        for (const auto &wall_node : fluid.wall_nodes)
          if (fluid.mesh.nodes[wall_node.node].distance(x) < 1e-12)
            return wall_node;
        throw std::out_of_range("no wall node there");
      }
    };
  } // namespace

  // Straight but for the tail's round tip, whose area the tail's own mesh misses by the same amount: together they fill
  // the box exactly.
  TEST(FluidMesh, FluidTailAndHeadFillTheBox)
  {
    const MeshedScene meshed(shipped_scene("reference-2d-casefile", coarse_mesh));
    const double      box = 40e-3 * 20e-3;
    EXPECT_NEAR(meshed.area() + meshed.swimmer.elasticity().volume() + meshed.scene.head.area_m2(), box, 1e-12 * box);
  }

  // A quadratic edge of half angle a misses r^2 a^5 / 30 of its circle's segment: relative to the disc a^4 / 60. Walls
  // are divided into at least 32 edges, the inner disc into more.
  TEST(FluidMesh, CurvedWallsEncloseTheAreaOfTheirCircles)
  {
    const MeshedScene meshed(shipped_scene("rotating-disc"));
    const double      exact = pi * (25e-6 - 1e-6);
    EXPECT_NEAR(meshed.area(), exact, std::pow(pi / 32., 4) / 60. * 26e-6 * pi);
  }

  TEST(FluidMesh, SurfaceNodesAreTheSwimmersAndWallNodesLieOnTheirWalls)
  {
    const MeshedScene meshed(shipped_scene("reference-2d-casefile", coarse_mesh));
    const auto        surface = meshed.swimmer.surface(meshed.swimmer.configuration_at_rest());
    ASSERT_EQ(surface.size(), meshed.fluid.surface_nodes.size());
    for (unsigned int k = 0; k < surface.size(); ++k)
      EXPECT_EQ(meshed.fluid.mesh.nodes[meshed.fluid.surface_nodes[k]], surface[k]);
    std::set<unsigned int> seen;
    for (const auto &[node, wall, name] : meshed.fluid.wall_nodes)
    {
      const auto &x = meshed.fluid.mesh.nodes[node];
      EXPECT_NEAR(name == "left" || name == "right" ? std::abs(x[0]) - 20e-3 : std::abs(x[1]) - 10e-3, 0., 1e-15)
          << name;
      EXPECT_EQ(wall, &meshed.scene.domain->walls.at(name));
      EXPECT_TRUE(seen.insert(node).second) << "named twice";
    }
  }

  TEST(FluidMesh, NoSlipWinsAtCornersWithOpenEndsAndInflows)
  {
    const MeshedScene box(shipped_scene("reference-2d-casefile", coarse_mesh));
    for (const double x : {-20e-3, 20e-3})
      for (const double y : {-10e-3, 10e-3})
        EXPECT_EQ(box.wall_node_at({x, y}).wall->condition, WallCondition::no_slip);
    const MeshedScene channel(shipped_scene("passive-tail-channel"));
    for (const double y : {-5e-3, 5e-3})
      EXPECT_EQ(channel.wall_node_at({-15e-3, y}).wall->condition, WallCondition::no_slip);
  }

  TEST(FluidMesh, RecordMakesTheSameMeshAgain)
  {
    const MeshedScene meshed(
        shipped_scene("annulus", {"numerics.mesh_size_m=4e-4", "numerics.mesh_size_corner_m=2e-4"}));
    const auto again = make_fluid_mesh(*meshed.scene.domain, record(meshed.fluid), MPI_COMM_WORLD);
    EXPECT_EQ(again.mesh.nodes, meshed.fluid.mesh.nodes);
    EXPECT_EQ(again.mesh.cells, meshed.fluid.mesh.cells);
    EXPECT_EQ(again.surface_nodes, meshed.fluid.surface_nodes);
    ASSERT_EQ(again.wall_nodes.size(), meshed.fluid.wall_nodes.size());
    for (unsigned int i = 0; i < again.wall_nodes.size(); ++i)
    {
      EXPECT_EQ(again.wall_nodes[i].node, meshed.fluid.wall_nodes[i].node);
      EXPECT_EQ(again.wall_nodes[i].wall, meshed.fluid.wall_nodes[i].wall);
    }
  }

  namespace
  {
    FluidMesh<2> symmetric_mesh(const MeshedScene &meshed)
    {
      const auto &swimmer = meshed.swimmer;
      return make_symmetric_fluid_mesh(*meshed.scene.domain, swimmer.surface(swimmer.configuration_at_rest()),
                                       swimmer.surface_mesh_size(), swimmer.pose_at_rest(), swimmer.pose_at_rest(),
                                       meshed.scene.numerics, MPI_COMM_WORLD);
    }

    std::vector<Scene> symmetric_scenes()
    {
      std::vector<Scene> scenes;
      scenes.push_back(shipped_scene("reference-2d-casefile", coarse_mesh));
      scenes.push_back(shipped_scene("passive-tail-channel", {"head.center_m=[0.0, 0.0]"}));
      scenes.push_back(shipped_scene("open-2d", coarse_mesh));
      for (const char *side : {"head.center_m=[-13e-3, 0.0]", "head.center_m=[8e-3, 0.0]"})
        scenes.push_back(shipped_scene("annulus", {"numerics.mesh_size_m=4e-4", side}));
      return scenes;
    }
  } // namespace

  TEST(SymmetricFluidMesh, IsItsOwnMirrorImageToTheLastDigit)
  {
    for (const Scene &scene : symmetric_scenes())
    {
      const MeshedScene  meshed(scene);
      const FluidMesh<2> fluid = symmetric_mesh(meshed);
      ASSERT_EQ(fluid.image_of_vertex.size(), fluid.mesh.n_vertices());
      const auto image_of = [&](const unsigned int node) {
        if (node < fluid.mesh.n_vertices())
          return fluid.image_of_vertex[node];
        const auto &[a, b] = fluid.mesh.edges()[node - fluid.mesh.n_vertices()];
        return fluid.mesh.edge_node(fluid.image_of_vertex[a], fluid.image_of_vertex[b]);
      };
      for (unsigned int node = 0; node < fluid.mesh.n_nodes(); ++node)
        EXPECT_EQ(fluid.mesh.nodes[image_of(node)], Point<2>(fluid.mesh.nodes[node][0], -fluid.mesh.nodes[node][1]));
    }
  }

  // The other mesh of the same region has the same surface and walls, and fills the same area but for round walls,
  // which are divided alike.
  TEST(SymmetricFluidMesh, HasTheSurfaceTheWallsAndTheAreaOfTheOtherMesh)
  {
    for (const Scene &scene : symmetric_scenes())
    {
      MeshedScene  meshed(scene);
      FluidMesh<2> fluid = symmetric_mesh(meshed);
      ASSERT_EQ(fluid.surface_nodes.size(), meshed.fluid.surface_nodes.size());
      for (unsigned int k = 0; k < fluid.surface_nodes.size(); ++k)
        EXPECT_LE(
            fluid.mesh.nodes[fluid.surface_nodes[k]].distance(meshed.fluid.mesh.nodes[meshed.fluid.surface_nodes[k]]),
            1e-17);
      ASSERT_EQ(fluid.wall_nodes.size(), meshed.fluid.wall_nodes.size());
      for (unsigned int i = 0; i < fluid.wall_nodes.size(); ++i)
      {
        const auto &a = fluid.wall_nodes[i], &b = meshed.fluid.wall_nodes[i];
        EXPECT_LE(fluid.mesh.nodes[a.node].distance(meshed.fluid.mesh.nodes[b.node]), 1e-16);
        EXPECT_EQ(a.wall->condition, b.wall->condition);
      }
      const double area = meshed.area();
      meshed.fluid      = std::move(fluid);
      EXPECT_NEAR(meshed.area(), area, 1e-12 * area);
    }
  }

  // speed_m_s is the mean: the parabola's maximum is 1.5 times that, after the ramp.
  TEST(WallVelocity, InflowIsAParabolaOfTheGivenMean)
  {
    const Scene scene = shipped_scene("passive-tail-channel");
    const auto  at    = [&](const double y, const double t) {
      return wall_velocity<2>(*scene.domain, "left", {-15e-3, y}, t);
    };
    constexpr int n    = 1000;
    double        mean = 0.;
    for (int i = 0; i < n; ++i)
      mean += at(10e-3 * ((i + .5) / n - .5), 1.)[0] / n; // midpoint rule on 1 - s^2: off by 1 / (2 n^2)
    EXPECT_NEAR(mean, 2e-3 * (1. + .5 / (n * n)), 1e-15);
    EXPECT_NEAR(at(0., 1.)[0], 3e-3, 1e-17);
    EXPECT_EQ(at(0., 1.)[1], 0.);
    EXPECT_NEAR(at(5e-3, 1.)[0], 0., 1e-17);
    EXPECT_EQ(at(0., 0.)[0], 0.);
    EXPECT_NEAR(at(0., 0.25)[0], 1.5e-3, 1e-17);
  }

  TEST(WallVelocity, RoundWallTurnsCounterClockwise)
  {
    const Scene scene = shipped_scene("rotating-disc");
    const auto  v     = wall_velocity<2>(*scene.domain, "outer", {5e-3, 0.}, 0.);
    EXPECT_NEAR(v[0], 0., 1e-17);
    EXPECT_NEAR(v[1], 5e-3, 1e-17);
  }
} // namespace swimtwin
