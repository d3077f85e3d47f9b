// The thin limit: a slab cut from an endless swimmer, a body in space of which nothing moves along z, moves as the
// swimmer in two dimensions.
#include <fom/body/mesh_around.h>
#include <fom/step/full_order_model.h>
#include <tests/datasets/example_scenes.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    constexpr double thickness_m = 3e-4;
    constexpr int    n_levels    = 3; // of nodes: z = 0, half and whole of the thickness

    Point<3> lifted(const Point<2> &x, const int level)
    {
      return {x[0], x[1], level * thickness_m / 2};
    }

    /// Meshes that share a curve are cut alike above it if they look at positions alone.
    bool comes_before(const Point<2> &a, const Point<2> &b)
    {
      return a[0] + .37 * a[1] < b[0] + .37 * b[1];
    }

    struct Slab
    {
      SimplexMesh<3>                                  mesh;
      std::vector<std::array<unsigned int, n_levels>> above; ///< of every node of the planar mesh

      std::vector<unsigned int> above_all(const std::vector<unsigned int> &planar) const
      {
        std::vector<unsigned int> nodes;
        for (const auto node : planar)
          nodes.insert(nodes.end(), above[node].begin(), above[node].end());
        return nodes;
      }
    };

    bool is_positive(const std::array<Point<3>, 4> &x)
    {
      return cross_product_3d(x[1] - x[0], x[2] - x[0]) * (x[3] - x[0]) > 0.;
    }

    /// Three tetrahedra above each triangle; above an edge the diagonal starts at that end which comes before.
    SimplexSoup<3> tetrahedra_above(const SimplexMesh<2> &planar)
    {
      const unsigned int n = planar.n_vertices();
      SimplexSoup<3>     soup;
      for (const int level : {0, 2})
        for (unsigned int v = 0; v < n; ++v)
          soup.vertices.push_back(lifted(planar.nodes[v], level));
      for (const auto &cell : planar.cells)
      {
        std::array<unsigned int, 3> v{cell[0], cell[1], cell[2]};
        std::sort(v.begin(), v.end(), [&](const unsigned int a, const unsigned int b) {
          return comes_before(planar.nodes[a], planar.nodes[b]);
        });
        const auto [a, b, c] = v;
        for (std::array<unsigned int, 4> corners :
             {std::array{a, b, c, n + c}, std::array{a, b, n + b, n + c}, std::array{a, n + a, n + b, n + c}})
        {
          if (const auto &x = soup.vertices; !is_positive({x[corners[0]], x[corners[1]], x[corners[2]], x[corners[3]]}))
            std::swap(corners[0], corners[1]);
          soup.cells.push_back(corners);
        }
      }
      return soup;
    }

    Slab slab_above(const SimplexMesh<2> &planar)
    {
      const unsigned int n = planar.n_vertices();
      Slab               slab{SimplexMesh<3>(tetrahedra_above(planar), MPI_COMM_WORLD), {}};
      for (unsigned int v = 0; v < n; ++v)
        slab.above.push_back({v, slab.mesh.edge_node(v, n + v), n + v});
      for (auto [a, b] : planar.edges())
      {
        if (comes_before(planar.nodes[b], planar.nodes[a]))
          std::swap(a, b);
        slab.above.push_back(
            {slab.mesh.edge_node(a, b), slab.mesh.edge_node(a, n + b), slab.mesh.edge_node(n + a, n + b)});
      }
      for (unsigned int node = 0; node < planar.n_nodes(); ++node)
        for (int level = 0; level < n_levels; ++level)
          slab.mesh.nodes[slab.above[node][level]] = lifted(planar.nodes[node], level);
      return slab;
    }

    /// Each its own mirror image: nothing moves along z.
    std::vector<unsigned int> own_images(const unsigned int n)
    {
      std::vector<unsigned int> image(n);
      std::iota(image.begin(), image.end(), 0u);
      return image;
    }

    /// Of the surface, whose node k is at levels of 3 k, 3 k + 1, 3 k + 2: the two faces above one edge.
    void add_faces_above(const FaceNodes<2> &edge, SurfaceMesh<3> &surface)
    {
      const auto [a, m, b] = edge;
      const auto at        = [](const unsigned int node, const unsigned int level) { return n_levels * node + level; };
      if (comes_before({surface.nodes[at(a, 0)][0], surface.nodes[at(a, 0)][1]},
                       {surface.nodes[at(b, 0)][0], surface.nodes[at(b, 0)][1]}))
      {
        surface.faces.push_back({at(a, 0), at(b, 0), at(b, 2), at(m, 0), at(b, 1), at(m, 1)});
        surface.faces.push_back({at(a, 0), at(b, 2), at(a, 2), at(m, 1), at(m, 2), at(a, 1)});
      }
      else
      {
        surface.faces.push_back({at(a, 0), at(b, 0), at(a, 2), at(m, 0), at(m, 1), at(a, 1)});
        surface.faces.push_back({at(b, 0), at(b, 2), at(a, 2), at(b, 1), at(m, 2), at(m, 1)});
      }
    }

    BodyMesh<3> slab_of(const BodyMesh<2> &planar)
    {
      const TailMesh<2> &flat = *planar.tail;
      Slab               tail = slab_above(flat.mesh);
      BodyMesh<3>        body;
      for (unsigned int k = 0; k < planar.surface.nodes.size(); ++k)
        for (int level = 0; level < n_levels; ++level)
        {
          const int node = planar.tail_node[k];
          body.surface.nodes.push_back(lifted(planar.surface.nodes[k], level));
          body.tail_node.push_back(node < 0 ? -1 : static_cast<int>(tail.above[node][level]));
        }
      for (const auto &edge : planar.surface.faces)
        add_faces_above(edge, body.surface);
      body.image = own_images(body.surface.nodes.size());
      std::array<unsigned int, 3> tip;
      std::transform(flat.axis_at_tip.begin(), flat.axis_at_tip.end(), tip.begin(),
                     [&](const unsigned int node) { return tail.above[node].front(); });
      const auto clamped = tail.above_all(flat.clamped_nodes), surface = tail.above_all(flat.surface_nodes);
      const auto image = own_images(tail.mesh.n_vertices());
      body.tail        = std::make_unique<TailMesh<3>>(TailMesh<3>{std::move(tail.mesh), clamped, surface, tip, image});
      return body;
    }

    FluidMesh<3> slab_of(const FluidMesh<2> &planar)
    {
      Slab         slab = slab_above(planar.mesh);
      FluidMesh<3> fluid{std::move(slab.mesh), slab.above_all(planar.surface_nodes), {}, {}};
      for (const auto &[node, wall, name] : planar.wall_nodes)
        for (const auto above : slab.above[node])
          fluid.wall_nodes.push_back({above, wall, name});
      fluid.image_of_vertex = own_images(fluid.mesh.n_vertices());
      return fluid;
    }

    /// A swimmer on a coarse mesh, and a scene in space that differs in its head and domain; their sizes do not matter
    /// on given meshes.
    Scene planar_scene(const std::vector<std::string> &more)
    {
      std::vector<std::string> overrides{"fluid.inertia=none",
                                         "time.steps_per_period=40",
                                         "numerics.mesh_size_m=4e-4",
                                         "numerics.mesh_size_corner_m=1.5e-4",
                                         "numerics.mesh_size_far_m=3e-3",
                                         "numerics.remesh_quality=1e-3"};
      overrides.insert(overrides.end(), more.begin(), more.end());
      return parse_scene(swimmer_toml, "planar", overrides);
    }

    /// The head's moment is that of the slab and its mirror image.
    Scene spatial_scene(const Scene &planar, std::vector<std::string> more)
    {
      for (const char *entry : {"dimension=3", "domain.size_m=[40e-3, 20e-3, 20e-3]", "head.shape=cylinder"})
        more.push_back(entry);
      Scene scene = planar_scene(more);
      scene.head.magnetization_A_m *= planar.head.volume(2) * 2. * thickness_m / scene.head.volume(3);
      return scene;
    }

    template <int dim>
    Instant<dim> after(FullOrderModel<dim> &model, const int n_steps)
    {
      for (int step = 0; step < n_steps; ++step)
        model.advance();
      EXPECT_EQ(model.counts().n_remeshes, 0);
      return model.now();
    }
  } // namespace

  TEST(PlaneStrainSlab, MovesAsInTwoDimensions)
  {
    for (const char *law : {"st-venant-kirchhoff", "neo-hookean"})
    {
      const std::vector<std::string> more{std::string("tail.law=") + law};
      const Scene                    flat = planar_scene(more), deep = spatial_scene(flat, more);
      const Swimmer<2>               swimmer(flat, MPI_COMM_WORLD);
      const FluidMesh<2>             fluid = mesh_around(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
      FullOrderModel<3>              slab(deep, slab_of(swimmer.body()), slab_of(fluid), MPI_COMM_WORLD);
      FullOrderModel<2>              planar(flat, MPI_COMM_WORLD);
      const int                      n_steps = 40;
      const RigidPose<2>             a       = after(planar, n_steps).configuration.pose;
      const RigidPose<3>             b       = after(slab, n_steps).configuration.pose;
      std::cout << law << ": after a period the head is at (" << a.center << ") m, the slab's at (" << b.center
                << ") m, turned by " << a.heading() << " and " << b.heading() << std::endl;
      EXPECT_NEAR(b.center[0] / a.center[0], 1., 5e-3);
      EXPECT_NEAR(b.center[1] / a.center[1], 1., 5e-3);
      EXPECT_NEAR(b.heading() / a.heading(), 1., 5e-3);
    }
  }
} // namespace swimtwin
