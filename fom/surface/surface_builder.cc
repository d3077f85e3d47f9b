#include <fom/surface/surface_builder.h>

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
    /// A triangle with two boundary edges that meet at nearly two right angles would be singular there when they are
    /// curved: its third edge is divided, and the new vertex pushed inwards.
    void free_corners(SimplexSoup<2> &soup, const std::vector<unsigned int> &next_on_boundary)
    {
      const unsigned int n_boundary  = next_on_boundary.size();
      const auto         is_boundary = [&](const unsigned int a, const unsigned int b) {
        return a < n_boundary && b < n_boundary && (next_on_boundary[a] == b || next_on_boundary[b] == a);
      };
      const auto is_bound = [&](const unsigned int p, const unsigned int q, const unsigned int r) {
        constexpr double   obtuse = -0.6;
        const Tensor<1, 2> a = soup.vertices[q] - soup.vertices[p], b = soup.vertices[r] - soup.vertices[p];
        return is_boundary(p, q) && is_boundary(p, r) && !is_boundary(q, r) && a * b < obtuse * a.norm() * b.norm();
      };
      for (unsigned int n = 0; n < soup.cells.size(); ++n)
        for (int v = 0; v < 3; ++v)
        {
          const auto         cell = soup.cells[n];
          const unsigned int p = cell[v], q = cell[(v + 1) % 3], r = cell[(v + 2) % 3];
          if (!is_bound(p, q, r))
            continue;
          for (unsigned int k = 0; k < soup.cells.size(); ++k)
            for (int w = 0; w < 3; ++w)
              if (const auto other = soup.cells[k]; other[(w + 1) % 3] == r && other[(w + 2) % 3] == q)
              {
                const unsigned int o = other[w], m = soup.vertices.size();
                soup.vertices.push_back(Point<2>(.4 * (soup.vertices[q] + Tensor<1, 2>(soup.vertices[r])) +
                                                 .1 * (soup.vertices[p] + Tensor<1, 2>(soup.vertices[o]))));
                // Half way between the edge's middle and that of the quadrilateral: inside both triangles' hull.
                soup.cells[n] = {p, q, m};
                soup.cells[k] = {o, r, m};
                soup.cells.push_back({p, m, r});
                soup.cells.push_back({o, m, q});
                w = 3;
                k = soup.cells.size();
              }
          break;
        }
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
    std::vector<unsigned int> number, next;
    for (const auto &loop : patch.loops)
    {
      const unsigned int first = next.size(), n = loop.nodes.size() / 2;
      for (unsigned int i = 0; i < n; ++i)
        next.push_back(first + (i + 1) % n);
    }
    free_corners(soup, next);
    for (const auto &loop : patch.loops)
    {
      const unsigned int first = number.size(), n = loop.nodes.size() / 2;
      for (unsigned int i = 0; i < n; ++i)
        number.push_back(surface.number_at(loop.nodes[2 * i]));
      for (unsigned int i = 0; i < n; ++i)
        surface.middle.emplace(edge_between(number[first + i], number[first + (i + 1) % n]), loop.nodes[2 * i + 1]);
    }
    for (unsigned int v = number.size(); v < soup.vertices.size(); ++v)
    {
      number.push_back(surface.number_at(patch.position(soup.vertices[v])));
    }
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
} // namespace swimtwin
