#include <fom/surface/surface_builder.h>

#include <fom/geometry/reflection.h>
#include <fom/meshing/boundary_faces.h>
#include <fom/meshing/triangulate.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    double signed_area(const std::vector<Point<2>> &polygon)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < polygon.size(); ++i)
      {
        const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        sum += .5 * (a[0] * b[1] - a[1] * b[0]);
      }
      return sum;
    }

    /// The region of a patch; outer loops run counter-clockwise there. Vertices are in the order of the loops.
    PlanarRegion region_of(const SurfacePatch &patch)
    {
      PlanarRegion region;
      region.size = patch.size;
      for (const auto &loop : patch.loops)
      {
        std::vector<Point<2>> polygon;
        for (unsigned int i = 0; i < loop.chart.size(); i += 2)
          polygon.push_back(loop.chart[i]);
        if (&loop == &patch.loops.front())
          region.outer = polygon;
        else
          region.holes.push_back(polygon);
      }
      return region;
    }
  } // namespace

  unsigned int QuadraticSurface::number_at(const Point<3> &x)
  {
    const auto [entry, is_new] = numbers_.try_emplace({x[0], x[1], x[2]}, corners.vertices.size());
    if (is_new)
      corners.vertices.push_back(x);
    return entry->second;
  }

  void QuadraticSurface::add(const std::array<Point<3>, 3> &vertices, const std::array<Point<3>, 3> &middles,
                             const int patch)
  {
    auto &triangle = corners.triangles.emplace_back();
    for (int v = 0; v < 3; ++v)
      triangle[v] = number_at(vertices[v]);
    for (int v = 0; v < 3; ++v)
      middle.emplace(edge_between(triangle[v], triangle[(v + 1) % 3]), middles[v]);
    patch_of.push_back(patch);
  }

  void add_patch(QuadraticSurface &surface, const SurfacePatch &patch, const MPI_Comm communicator)
  {
    const PlanarRegion region = region_of(patch);
    AssertThrow(signed_area(region.outer) > 0., ExcInternalError());
    SimplexSoup<2>            soup = triangulate(region, communicator);
    std::vector<unsigned int> number;
    std::set<Edge>            boundary; // of the region: its vertices come first, loop by loop
    for (const auto &loop : patch.loops)
    {
      const unsigned int first = number.size(), n = loop.nodes.size() / 2;
      for (unsigned int i = 0; i < n; ++i)
      {
        boundary.insert(edge_between(first + i, first + (i + 1) % n));
        number.push_back(surface.number_at(loop.nodes[2 * i]));
      }
      for (unsigned int i = 0; i < n; ++i)
        surface.middle.emplace(edge_between(number[first + i], number[first + (i + 1) % n]), loop.nodes[2 * i + 1]);
    }
    free_corners_from_boundary(soup, boundary);
    for (unsigned int v = number.size(); v < soup.vertices.size(); ++v)
      number.push_back(surface.number_at(patch.position(soup.vertices[v])));
    for (const auto &cell : soup.cells)
    {
      surface.corners.triangles.push_back({number[cell[0]], number[cell[1]], number[cell[2]]});
      surface.patch_of.push_back(patch.number);
      for (int v = 0; v < 3; ++v)
      {
        const unsigned int a = cell[v], b = cell[(v + 1) % 3];
        if (const Edge e = edge_between(number[a], number[b]); !surface.middle.count(e))
          surface.middle[e] = patch.position(Point<2>(.5 * (soup.vertices[a] + Tensor<1, 2>(soup.vertices[b]))));
      }
    }
  }

  SurfacePatch plane_patch(const std::vector<std::vector<Point<3>>> &loops, const int left_out,
                           const SpatialSizeField &size)
  {
    const int    i = left_out == 0 ? 1 : 0, j = left_out == 2 ? 1 : 2;
    const double height = loops.front().front()[left_out];
    SurfacePatch patch;
    for (const auto &nodes : loops)
    {
      auto &loop = patch.loops.emplace_back();
      for (const auto &x : nodes)
        loop.append(Point<2>(x[i], x[j]), x);
    }
    patch.position = [=](const Point<2> &p) {
      Point<3> x;
      x[i]        = p[0];
      x[j]        = p[1];
      x[left_out] = height;
      return x;
    };
    patch.size = [size, position = patch.position](const Point<2> &p) { return size(position(p)); };
    // Walk the outer loop counter-clockwise.
    auto &outer = patch.loops.front();
    if (signed_area(outer.chart) < 0.)
    {
      std::reverse(outer.chart.begin() + 1, outer.chart.end());
      std::reverse(outer.nodes.begin() + 1, outer.nodes.end());
    }
    return patch;
  }

  void curve_edges(SimplexMesh<3> &mesh, const QuadraticSurface &half, const std::vector<unsigned int> &image)
  {
    for (const auto &[edge, x] : half.middle)
    {
      mesh.nodes[mesh.edge_node(image[edge[0]], image[edge[1]])] = mirrored(x);
      mesh.nodes[mesh.edge_node(edge[0], edge[1])]               = x;
    }
  }
} // namespace swimtwin
