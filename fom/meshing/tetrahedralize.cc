#include <fom/meshing/tetrahedralize.h>

#include <datasets/system/error.h>
#include <fom/meshing/boundary_faces.h>
#include <fom/meshing/gmsh_session.h>

#include <gmsh.h>

#include <algorithm>
#include <unordered_map>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr int three_node_triangle = 2, four_node_tetrahedron = 4;

    constexpr int outer_surface = 1, surface_of_holes = 2; ///< in gmsh

    /// The triangles from `first` to before `last`, and their vertices, as one of gmsh's surfaces. Nodes get the tags
    /// 1, 2, ... in their order.
    void add_surface(const TriangleSurface &surface, const int entity, const std::size_t first, const std::size_t last,
                     const double scale)
    {
      std::vector<char>        is_here(surface.vertices.size(), 0);
      std::vector<std::size_t> tags, corners;
      std::vector<double>      coordinates;
      for (std::size_t t = first; t < last; ++t)
        for (const auto v : surface.triangles[t])
        {
          is_here[v] = 1;
          corners.push_back(v + 1);
        }
      for (std::size_t v = 0; v < is_here.size(); ++v)
        if (is_here[v])
        {
          tags.push_back(v + 1);
          for (int c = 0; c < 3; ++c)
            coordinates.push_back(surface.vertices[v][c] / scale);
        }
      gmsh::model::addDiscreteEntity(2, entity);
      gmsh::model::mesh::addNodes(2, entity, tags, coordinates);
      gmsh::model::mesh::addElementsByType(entity, three_node_triangle, {}, corners);
    }

    /// Returns the loops of surfaces that bound the region.
    std::vector<int> add_boundary(const TriangleSurface &surface, const double scale)
    {
      const std::size_t n = surface.triangles.size(), n_outside = std::min(n, surface.first_of_hole);
      add_surface(surface, outer_surface, 0, n_outside, scale);
      std::vector<int> loops{gmsh::model::geo::addSurfaceLoop({outer_surface})};
      if (surface.has_hole())
      {
        add_surface(surface, surface_of_holes, n_outside, n, scale);
        loops.push_back(gmsh::model::geo::addSurfaceLoop({surface_of_holes}));
      }
      return loops;
    }

    SimplexSoup<3> read_mesh(const TriangleSurface &surface, const double scale)
    {
      SimplexSoup<3>           soup{surface.vertices, {}};
      std::vector<std::size_t> tags, elements, corners;
      std::vector<double>      coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      std::unordered_map<std::size_t, std::size_t> place;
      for (std::size_t i = 0; i < tags.size(); ++i)
        place[tags[i]] = i;
      std::unordered_map<std::size_t, unsigned int> inner;
      gmsh::model::mesh::getElementsByType(four_node_tetrahedron, elements, corners);
      for (std::size_t i = 0; i + 3 < corners.size(); i += 4)
      {
        std::array<unsigned int, 4> cell;
        for (int v = 0; v < 4; ++v)
          if (const std::size_t tag = corners[i + v]; tag <= surface.vertices.size())
            cell[v] = tag - 1;
          else
          {
            const auto [entry, is_new] = inner.try_emplace(tag, soup.vertices.size());
            if (is_new)
            {
              const double *x = coordinates.data() + 3 * place.at(tag);
              soup.vertices.emplace_back(scale * x[0], scale * x[1], scale * x[2]);
            }
            cell[v] = entry->second;
          }
        soup.cells.push_back(cell);
      }
      return soup;
    }

    void orient(SimplexSoup<3> &soup)
    {
      for (auto &[a, b, c, d] : soup.cells)
      {
        const auto &x = soup.vertices;
        if (cross_product_3d(x[b] - x[a], x[c] - x[a]) * (x[d] - x[a]) < 0.)
          std::swap(c, d);
      }
    }

    void refuse_open_surface(const TriangleSurface &surface)
    {
      std::map<Edge, int> uses;
      for (const auto &triangle : surface.triangles)
        for (int v = 0; v < 3; ++v)
          ++uses[edge_between(triangle[v], triangle[(v + 1) % 3])];
      for (const auto &[edge, n] : uses)
        if (n != 2)
          throw ComputationError("the surface of the region is not closed");
    }
  } // namespace

  SimplexSoup<3> tetrahedralize(const TriangleSurface &surface, const SpatialSizeField &size,
                                const MPI_Comm communicator)
  {
    return mesh_on_first_rank<3>(
        [&] {
          refuse_open_surface(surface);
          begin_gmsh_model();
          const double scale = extent(surface.vertices);
          gmsh::model::geo::addVolume(add_boundary(surface, scale));
          gmsh::model::geo::synchronize();
          gmsh::model::mesh::setSizeCallback([&](int, int, const double x, const double y, const double z) {
            return size(Point<3>(scale * x, scale * y, scale * z)) / scale;
          });
          gmsh::model::mesh::generate(3);
          gmsh::model::mesh::removeSizeCallback();
          SimplexSoup<3> soup = read_mesh(surface, scale);
          orient(soup);
          free_corners_from_boundary(soup, surface);
          return soup;
        },
        communicator);
  }
} // namespace swimtwin
