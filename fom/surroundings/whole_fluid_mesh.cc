// The fluid around a body in space of which no mirror image is known: meshed as a whole.
#include <datasets/surface/closed_surface.h>
#include <fom/geometry/reflection.h>
#include <fom/mesh/fluid_mesh.h>
#include <fom/mesh/inverted_element.h>
#include <fom/meshing/graded_size.h>
#include <fom/space/untangling.h>
#include <fom/surroundings/names_of_walls.h>
#include <fom/surroundings/size_around.h>
#include <fom/surroundings/spatial_walls.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr int patch_of_body = -1; ///< those of walls count from 0

    /// A boundary of the fluid, and the names of its walls by patch.
    struct WholeBoundary
    {
      QuadraticSurface         surface;
      std::vector<std::string> wall_of_patch;
    };

    using ThreePoints = std::array<Point<3>, 3>;

    void add_walls_of_surface(WholeBoundary &boundary, const ClosedSurface &walls)
    {
      boundary.wall_of_patch = walls.patches;
      const auto points      = [&](const SurfaceFace &face, const int first) {
        ThreePoints x;
        for (int v = 0; v < 3; ++v)
          for (int c = 0; c < 3; ++c)
            x[v][c] = walls.nodes[face[first + v]][c];
        return x;
      };
      for (unsigned int f = 0; f < walls.faces.size(); ++f)
        boundary.surface.add(points(walls.faces[f], 0), points(walls.faces[f], 3), walls.patch_of_face[f]);
    }

    std::string name_behind(const std::string &wall)
    {
      return wall == "front" ? "back" : wall;
    }

    /// The half of walls that are known by their shape, and its reflection.
    void add_walls_of_shape(WholeBoundary &boundary, const Domain &domain, const Point<3> &center,
                            const SpatialSizeField &size, const MPI_Comm communicator)
    {
      QuadraticSurface   half;
      const SpatialWalls walls  = add_walls(half, domain, center, size, communicator);
      const int          n_half = walls.wall_of_patch.size();
      for (const auto &name : walls.wall_of_patch)
        boundary.wall_of_patch.push_back(name);
      for (const auto &name : walls.wall_of_patch)
        boundary.wall_of_patch.push_back(name_behind(name));
      for (unsigned int t = 0; t < half.corners.triangles.size(); ++t)
      {
        ThreePoints vertices, middles;
        for (int v = 0; v < 3; ++v)
        {
          const unsigned int a = half.corners.triangles[t][v], b = half.corners.triangles[t][(v + 1) % 3];
          vertices[v] = half.corners.vertices[a];
          middles[v]  = half.middle.at(edge_between(a, b));
        }
        const int patch = half.patch_of[t] - walls.first_patch;
        boundary.surface.add(vertices, middles, patch);
        for (int v = 0; v < 3; ++v)
        {
          vertices[v] = mirrored(vertices[v]);
          middles[v]  = mirrored(middles[v]);
        }
        boundary.surface.add({vertices[0], vertices[2], vertices[1]}, {middles[2], middles[1], middles[0]},
                             n_half + patch);
      }
    }

    void add_body_as_hole(QuadraticSurface &surface, const BodyMesh<3> &body, const std::vector<Point<3>> &x)
    {
      surface.corners.first_of_hole = surface.corners.triangles.size();
      for (const auto &face : body.surface.faces)
        surface.add({x[face[0]], x[face[1]], x[face[2]]}, {x[face[3]], x[face[4]], x[face[5]]}, patch_of_body);
    }

    /// Not larger than what the triangles of the walls ask for.
    SpatialSizeField size_between(const SpatialSizeField &around_body, const ClosedSurface &walls,
                                  const Numerics &numerics)
    {
      std::vector<std::pair<Point<3>, double>> prescribed;
      for (const auto &face : walls.faces)
        for (int v = 0; v < 3; ++v)
        {
          const auto &a = walls.nodes[face[v]], &b = walls.nodes[face[(v + 1) % 3]];
          prescribed.emplace_back(Point<3>(a[0], a[1], a[2]), (b - a).norm());
        }
      const auto at_walls = graded_size(prescribed, numerics.mesh_growth, numerics.mesh_size_far_m);
      return [=](const Point<3> &x) { return std::min(around_body(x), at_walls(x)); };
    }

    std::vector<unsigned int> nodes_on_body(const SimplexMesh<3> &mesh, const QuadraticSurface &surface,
                                            const BodyMesh<3> &body, const std::vector<Point<3>> &x)
    {
      std::vector<unsigned int> nodes(x.size());
      for (const auto &face : body.surface.faces)
        for (int v = 0; v < 3; ++v)
        {
          const unsigned int a = surface.existing_number_at(x[face[v]]),
                             b = surface.existing_number_at(x[face[(v + 1) % 3]]);
          nodes[face[v]]       = a;
          nodes[face[3 + v]]   = mesh.edge_node(a, b);
        }
      return nodes;
    }

    std::vector<WallNode> nodes_on_walls(const Domain &domain, const SimplexMesh<3> &mesh,
                                         const WholeBoundary &boundary)
    {
      const auto  &surface = boundary.surface;
      NamesOfWalls names(domain, mesh.n_nodes());
      for (unsigned int t = 0; t < surface.corners.first_of_hole; ++t)
        for (int v = 0; v < 3; ++v)
        {
          const unsigned int a = surface.corners.triangles[t][v], b = surface.corners.triangles[t][(v + 1) % 3];
          names.add(a, boundary.wall_of_patch[surface.patch_of[t]]);
          names.add(mesh.edge_node(a, b), boundary.wall_of_patch[surface.patch_of[t]]);
        }
      return names.nodes();
    }

    FluidMesh<3> make_whole_with_sizes(const Domain &domain, const BodyMesh<3> &body, const std::vector<Point<3>> &x,
                                       const Point<3> &center, const SpatialSizeField &size,
                                       const MPI_Comm communicator)
    {
      WholeBoundary boundary;
      if (domain.surface)
        add_walls_of_surface(boundary, *domain.surface);
      else
        add_walls_of_shape(boundary, domain, center, size, communicator);
      add_body_as_hole(boundary.surface, body, x);

      FluidMesh<3> fluid{
          SimplexMesh<3>(tetrahedralize(boundary.surface.corners, size, communicator), communicator), {}, {}, {}};
      for (const auto &[edge, middle] : boundary.surface.middle)
        fluid.mesh.nodes[fluid.mesh.edge_node(edge[0], edge[1])] = middle;
      untangle(fluid.mesh, boundary.surface);
      fluid.surface_nodes = nodes_on_body(fluid.mesh, boundary.surface, body, x);
      fluid.wall_nodes    = nodes_on_walls(domain, fluid.mesh, boundary);
      refuse_inverted_elements(fluid.mesh, name_of_fluid_mesh);
      return fluid;
    }
  } // namespace

  FluidMesh<3> make_whole_fluid_mesh(const Domain &domain, const BodyMesh<3> &body, const std::vector<Point<3>> &x,
                                     const Point<3> &center, const Numerics &numerics, const MPI_Comm communicator)
  {
    SpatialSizeField size = size_around(body, x, numerics);
    if (domain.surface)
      size = size_between(size, *domain.surface, numerics);
    return first_not_inverted([&](const double factor) {
      return make_whole_with_sizes(domain, body, x, center, scaled(size, factor), communicator);
    });
  }
} // namespace swimtwin
