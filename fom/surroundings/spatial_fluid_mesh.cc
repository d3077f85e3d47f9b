// The fluid around a body in space: meshed at z >= 0 and reflected.
#include <fom/geometry/reflection.h>
#include <fom/mesh/fluid_mesh.h>
#include <fom/mesh/inverted_element.h>
#include <fom/meshing/graded_size.h>
#include <fom/space/untangling.h>
#include <fom/surroundings/names_of_walls.h>
#include <fom/surroundings/size_around.h>
#include <fom/surroundings/spatial_walls.h>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr int body_patch = 0, mirror_patch = 1;

    bool is_upper(const FaceNodes<3> &face, const std::vector<Point<3>> &at_rest)
    {
      return at_rest[face[0]][2] + at_rest[face[1]][2] + at_rest[face[2]][2] > 0.;
    }

    void add_body(QuadraticSurface &surface, const BodyMesh<3> &body, const std::vector<Point<3>> &x)
    {
      for (const auto &face : body.surface.faces)
        if (is_upper(face, body.surface.nodes))
          surface.add({x[face[0]], x[face[1]], x[face[2]]}, {x[face[3]], x[face[4]], x[face[5]]}, body_patch);
    }

    /// The mesh's node at every node of the body's surface.
    std::vector<unsigned int> find_surface_nodes(const SimplexMesh<3> &mesh, const QuadraticSurface &half,
                                                 const std::vector<unsigned int> &image, const BodyMesh<3> &body,
                                                 const std::vector<Point<3>> &x)
    {
      std::vector<unsigned int> nodes(x.size());
      const auto                vertex = [&](const unsigned int k) { return half.existing_number_at(x[k]); };
      for (const auto &face : body.surface.faces)
        if (is_upper(face, body.surface.nodes))
          for (int v = 0; v < 3; ++v)
          {
            const unsigned int a = vertex(face[v]), b = vertex(face[(v + 1) % 3]);
            nodes[body.image[face[v]]]     = image[a];
            nodes[face[v]]                 = a;
            nodes[body.image[face[3 + v]]] = mesh.edge_node(image[a], image[b]);
            nodes[face[3 + v]]             = mesh.edge_node(a, b);
          }
      return nodes;
    }

    std::vector<WallNode> find_wall_nodes(const Domain &domain, const SimplexMesh<3> &mesh,
                                          const QuadraticSurface &half, const std::vector<unsigned int> &image,
                                          const SpatialWalls &walls)
    {
      NamesOfWalls names(domain, mesh.n_nodes());
      for (unsigned int t = 0; t < half.corners.triangles.size(); ++t)
        if (const int patch = half.patch_of[t] - walls.first_patch; patch >= 0)
        {
          const std::string wall = walls.wall_of_patch[patch], behind = wall == "front" ? "back" : wall;
          for (int v = 0; v < 3; ++v)
          {
            const unsigned int a = half.corners.triangles[t][v], b = half.corners.triangles[t][(v + 1) % 3];
            names.add(a, wall);
            names.add(mesh.edge_node(a, b), wall);
            names.add(image[a], behind);
            names.add(mesh.edge_node(image[a], image[b]), behind);
          }
        }
      return names.nodes();
    }

    FluidMesh<3> make_with_sizes(const Domain &domain, const BodyMesh<3> &body, const std::vector<Point<3>> &x,
                                 const Point<3> &center, const SpatialSizeField &size, const MPI_Comm communicator)
    {
      QuadraticSurface half;
      add_body(half, body, x);
      const SpatialWalls    walls = add_walls(half, domain, center, size, communicator);
      std::vector<Point<3>> hole;
      for (const auto k : body.plane_loop)
        hole.push_back(x[k]);
      auto plane   = plane_patch({walls.plane_loop, hole}, 2, size);
      plane.number = mirror_patch;
      add_patch(half, plane, communicator);

      std::vector<unsigned int> image;
      const SimplexSoup<3>      soup = reflect(tetrahedralize(half.corners, size, communicator), 0., image);
      FluidMesh<3>              fluid{SimplexMesh<3>(soup, communicator), {}, {}, image};
      curve_edges(fluid.mesh, half, image);
      untangle(fluid.mesh, half, image, mirror_patch);
      fluid.surface_nodes = find_surface_nodes(fluid.mesh, half, image, body, x);
      fluid.wall_nodes    = find_wall_nodes(domain, fluid.mesh, half, image, walls);
      refuse_inverted_elements(fluid.mesh, name_of_fluid_mesh);
      return fluid;
    }
  } // namespace

  FluidMesh<3> make_fluid_mesh(const Domain &domain, const BodyMesh<3> &body, const std::vector<Point<3>> &x,
                               const Point<3> &center, const Numerics &numerics, const MPI_Comm communicator)
  {
    const SpatialSizeField size = size_around(body, x, numerics);
    return first_not_inverted([&](const double factor) {
      return make_with_sizes(domain, body, x, center, scaled(size, factor), communicator);
    });
  }
} // namespace swimtwin
