#include <fom/meshing/triangulate.h>

#include <datasets/system/error.h>
#include <fom/meshing/gmsh_session.h>

#include <gmsh.h>

#include <cmath>
#include <numeric>
#include <string>
#include <unordered_map>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    int add_polygon(const std::vector<Point<2>> &polygon, const double scale)
    {
      std::vector<int> points, lines;
      for (const auto &x : polygon)
        points.push_back(gmsh::model::geo::addPoint(x[0] / scale, x[1] / scale, 0.));
      for (unsigned int i = 0; i < points.size(); ++i)
      {
        lines.push_back(gmsh::model::geo::addLine(points[i], points[(i + 1) % points.size()]));
        gmsh::model::geo::mesh::setTransfiniteCurve(lines.back(), 2);
      }
      return gmsh::model::geo::addCurveLoop(lines);
    }

    /// Read the mesh of the current model. Points of the geometry have the tags 1, 2, ... in the order of their making.
    SimplexSoup<2> read_mesh(const std::vector<Point<2>> &boundary_points, const double scale)
    {
      std::vector<std::size_t> tags;
      std::vector<double>      coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      std::unordered_map<std::size_t, std::size_t> position_in_list;
      for (std::size_t i = 0; i < tags.size(); ++i)
        position_in_list[tags[i]] = i;

      SimplexSoup<2>                                soup;
      std::unordered_map<std::size_t, unsigned int> vertex_of_tag;
      for (unsigned int i = 0; i < boundary_points.size(); ++i)
      {
        std::vector<std::size_t> tag;
        std::vector<double>      x, t;
        gmsh::model::mesh::getNodes(tag, x, t, 0, i + 1);
        vertex_of_tag[tag.at(0)] = i;
        soup.vertices.push_back(boundary_points[i]);
      }

      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> element_tags, node_tags;
      gmsh::model::mesh::getElements(types, element_tags, node_tags, 2);
      constexpr int three_node_triangle = 2;
      for (std::size_t block = 0; block < types.size(); ++block)
        if (types[block] == three_node_triangle)
          for (std::size_t i = 0; i + 2 < node_tags[block].size(); i += 3)
          {
            std::array<unsigned int, 3> cell;
            for (int v = 0; v < 3; ++v)
            {
              const auto tag            = node_tags[block][i + v];
              const auto [entry, fresh] = vertex_of_tag.try_emplace(tag, soup.vertices.size());
              if (fresh)
              {
                const auto p = position_in_list.at(tag);
                soup.vertices.emplace_back(scale * coordinates[3 * p], scale * coordinates[3 * p + 1]);
              }
              cell[v] = entry->second;
            }
            soup.cells.push_back(cell);
          }
      return soup;
    }

    using Segment = std::array<Point<2>, 2>;

    /// Positive to the left, negative to the right, zero straight on, up to round-off: pieces of one side are on a
    /// line, and do not cross.
    double turn(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      constexpr double round_off = 1e-10; // a sine
      const double     turn      = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      return std::abs(turn) > round_off * a.distance(b) * a.distance(c) ? turn : 0.;
    }

    bool cross(const Segment &s, const Segment &t)
    {
      return turn(s[0], s[1], t[0]) * turn(s[0], s[1], t[1]) < 0. &&
             turn(t[0], t[1], s[0]) * turn(t[0], t[1], s[1]) < 0.;
    }

    /// gmsh 4.8 ends the process when outlines cross: it throws inside a parallel region. So they are checked before.
    bool outlines_cross(const PlanarRegion &region)
    {
      std::vector<Segment> segments;
      const auto           append = [&](const std::vector<Point<2>> &polygon) {
        for (unsigned int i = 0; i < polygon.size(); ++i)
          segments.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
      };
      append(region.outer);
      for (const auto &hole : region.holes)
        append(hole);
      for (unsigned int i = 0; i < segments.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          if (cross(segments[i], segments[j]))
            return true;
      return false;
    }

    SimplexSoup<2> triangulate_here(const PlanarRegion &region)
    {
      begin_gmsh_model();
      const double          scale  = extent(region.outer);
      std::vector<int>      loops  = {add_polygon(region.outer, scale)};
      std::vector<Point<2>> points = region.outer;
      for (const auto &hole : region.holes)
      {
        loops.push_back(add_polygon(hole, scale));
        points.insert(points.end(), hole.begin(), hole.end());
      }
      gmsh::model::geo::addPlaneSurface(loops);
      gmsh::model::geo::synchronize();
      gmsh::model::mesh::setSizeCallback([&](int, int, const double x, const double y, double) {
        return region.size(Point<2>(scale * x, scale * y)) / scale;
      });
      gmsh::model::mesh::generate(2);
      gmsh::model::mesh::removeSizeCallback();
      return read_mesh(points, scale);
    }

    Point<2> reflected(const Point<2> &x)
    {
      return {x[0], -x[1]};
    }

    /// Reflect a polygon and walk it backwards, so that its orientation and its first point stay.
    std::vector<Point<2>> reflected(const std::vector<Point<2>> &polygon)
    {
      std::vector<Point<2>> result{reflected(polygon.front())};
      for (unsigned int i = polygon.size() - 1; i > 0; --i)
        result.push_back(reflected(polygon[i]));
      return result;
    }

    SimplexSoup<2> triangulate_reflected(const PlanarRegion &region)
    {
      PlanarRegion image{reflected(region.outer), {}, [&](const Point<2> &x) { return region.size(reflected(x)); }};
      for (const auto &hole : region.holes)
        image.holes.push_back(reflected(hole));
      SimplexSoup<2> soup = triangulate_here(image);

      std::vector<unsigned int> original(soup.vertices.size());
      std::iota(original.begin(), original.end(), 0);
      unsigned int first     = 0;
      const auto   walk_back = [&](const unsigned int n) {
        for (unsigned int i = 1; i < n; ++i)
          original[first + i] = first + n - i;
        first += n;
      };
      walk_back(region.outer.size());
      for (const auto &hole : region.holes)
        walk_back(hole.size());

      SimplexSoup<2> result{std::vector<Point<2>>(soup.vertices.size()), soup.cells};
      for (unsigned int v = 0; v < soup.vertices.size(); ++v)
        result.vertices[original[v]] = reflected(soup.vertices[v]);
      for (auto &cell : result.cells)
        for (auto &v : cell)
          v = original[v];
      return result;
    }

    void orient(SimplexSoup<2> &soup)
    {
      for (auto &[a, b, c] : soup.cells)
      {
        const auto &v = soup.vertices;
        if ((v[b][0] - v[a][0]) * (v[c][1] - v[a][1]) - (v[b][1] - v[a][1]) * (v[c][0] - v[a][0]) < 0.)
          std::swap(b, c);
      }
    }
  } // namespace

  SimplexSoup<2> triangulate(const PlanarRegion &region, const MPI_Comm communicator)
  {
    return mesh_on_first_rank<2>(
        [&] {
          if (outlines_cross(region))
            throw ComputationError("the body's surface crosses itself or a wall");
          SimplexSoup<2> soup = region.mirror ? triangulate_reflected(region) : triangulate_here(region);
          orient(soup);
          return soup;
        },
        communicator);
  }
} // namespace swimtwin
