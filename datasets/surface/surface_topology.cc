#include <datasets/surface/surface_topology.h>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <utility>

namespace swimtwin
{
  using Eigen::Vector3d;

  namespace
  {
    using Edge = std::array<unsigned int, 2>; ///< the smaller number first

    Edge edge_of(const SurfaceFace &face, const int k)
    {
      return {std::min(face[k], face[(k + 1) % 3]), std::max(face[k], face[(k + 1) % 3])};
    }

    std::map<Edge, std::vector<unsigned int>> faces_at_edges(const SurfaceSoup &soup)
    {
      std::map<Edge, std::vector<unsigned int>> faces;
      for (unsigned int f = 0; f < soup.faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
          faces[edge_of(soup.faces[f], k)].push_back(f);
      return faces;
    }

    std::string between(const SurfaceSoup &soup, const Edge &edge)
    {
      return fmt::format("from {} to {}", coordinates(soup.points[edge[0]]), coordinates(soup.points[edge[1]]));
    }

    template <typename Place>
    void renumber(SurfaceSoup &soup, const Place &place_of)
    {
      std::vector<Vector3d> points;
      for (auto &face : soup.faces)
        for (int a = 0; a < (soup.is_curved ? 6 : 3); ++a)
          face[a] = place_of(face[a], points);
      soup.points = std::move(points);
    }

    void merge_same(SurfaceSoup &soup)
    {
      std::map<std::array<double, 3>, unsigned int> number;
      renumber(soup, [&](const unsigned int point, std::vector<Vector3d> &points) {
        const Vector3d x           = soup.points[point] + Vector3d::Zero(); // no minus zero
        const auto [entry, is_new] = number.try_emplace({x[0], x[1], x[2]}, points.size());
        if (is_new)
          points.push_back(x);
        return entry->second;
      });
    }

    bool has_open_edge(const SurfaceSoup &soup)
    {
      const auto faces = faces_at_edges(soup);
      return std::any_of(faces.begin(), faces.end(), [](const auto &entry) { return entry.second.size() == 1; });
    }

    /// On a grid of that width, in whose neighbouring cells a partner is looked for.
    void merge_close(SurfaceSoup &soup, const double distance)
    {
      const Vector3d                                            low = extent(soup.points).low;
      std::map<std::array<long long, 3>, std::vector<unsigned>> cells;
      std::map<unsigned int, unsigned int>                      number; // of points seen before
      renumber(soup, [&](const unsigned int point, std::vector<Vector3d> &points) {
        if (const auto known = number.find(point); known != number.end())
          return known->second;
        const Vector3d           x = soup.points[point];
        std::array<long long, 3> cell;
        for (int c = 0; c < 3; ++c)
          cell[c] = std::llround((x[c] - low[c]) / distance);
        for (long long i = -1; i <= 1; ++i)
          for (long long j = -1; j <= 1; ++j)
            for (long long k = -1; k <= 1; ++k)
              if (const auto near = cells.find({cell[0] + i, cell[1] + j, cell[2] + k}); near != cells.end())
                for (const unsigned int other : near->second)
                  if ((points[other] - x).norm() <= distance)
                    return number[point] = other;
        cells[cell].push_back(points.size());
        points.push_back(x);
        return number[point] = points.size() - 1;
      });
    }

    std::optional<std::string> flat_triangle(const SurfaceSoup &soup)
    {
      constexpr double            without_area = 1e-9;
      std::size_t                 n            = 0;
      std::optional<unsigned int> first;
      for (unsigned int f = 0; f < soup.faces.size(); ++f)
      {
        const auto &face = soup.faces[f];
        if (triangle_quality(soup.points[face[0]], soup.points[face[1]], soup.points[face[2]]) > without_area)
          continue;
        ++n;
        first = first.value_or(f);
      }
      if (!first)
        return std::nullopt;
      return fmt::format("{} of its {} triangles {} no area, the first at {}; remove them, or remesh the surface", n,
                         soup.faces.size(), n == 1 ? "has" : "have", coordinates(soup.points[soup.faces[*first][0]]));
    }

    std::optional<std::string> edge_not_shared_by_two(const SurfaceSoup &soup)
    {
      std::size_t         n_open = 0, n_many = 0, most = 0;
      std::optional<Edge> open, many;
      for (const auto &[edge, faces] : faces_at_edges(soup))
        if (faces.size() == 1)
        {
          ++n_open;
          open = open.value_or(edge);
        }
        else if (faces.size() > 2)
        {
          ++n_many;
          most = std::max(most, faces.size());
          many = many.value_or(edge);
        }
      if (many)
        return fmt::format(
            "{} of its edges {} to more than two triangles (up to {}), the first {}; remove inner walls and "
            "triangles that are there twice",
            n_many, n_many == 1 ? "belongs" : "belong", most, between(soup, *many));
      if (open)
        return fmt::format("it is not closed: {} of its edges {} to one triangle alone, the first {}; close the holes "
                           "(MeshLab: Close Holes), or export the whole solid",
                           n_open, n_open == 1 ? "belongs" : "belong", between(soup, *open));
      return std::nullopt;
    }

    /// Around a point of a surface its triangles form one ring.
    std::optional<std::string> point_of_two_rings(const SurfaceSoup &soup)
    {
      std::vector<std::vector<unsigned int>> faces_at(soup.points.size());
      for (unsigned int f = 0; f < soup.faces.size(); ++f)
        for (int v = 0; v < 3; ++v)
          faces_at[soup.faces[f][v]].push_back(f);
      std::size_t                 n = 0;
      std::optional<unsigned int> first;
      for (unsigned int point = 0; point < faces_at.size(); ++point)
      {
        std::map<unsigned int, std::vector<unsigned int>> beside; // neighbours on the ring
        for (const unsigned int f : faces_at[point])
        {
          std::vector<unsigned int> others;
          for (int v = 0; v < 3; ++v)
            if (soup.faces[f][v] != point)
              others.push_back(soup.faces[f][v]);
          beside[others[0]].push_back(others[1]);
          beside[others[1]].push_back(others[0]);
        }
        if (beside.empty())
          continue; // the middle of an edge
        std::size_t  length = 1;
        unsigned int before = beside.begin()->first, here = beside.begin()->second.front();
        for (; here != beside.begin()->first; ++length)
        {
          const auto &next = beside.at(here);
          here             = std::exchange(before, here) == next[0] ? next[1] : next[0];
        }
        if (length == beside.size())
          continue;
        ++n;
        first = first.value_or(point);
      }
      if (!first)
        return std::nullopt;
      return fmt::format("it touches itself at {} {}, the first {}; part it there, or join it along an edge", n,
                         n == 1 ? "point" : "points", coordinates(soup.points[*first]));
    }
  } // namespace

  std::string coordinates(const Vector3d &x)
  {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
  }

  void merge_points(SurfaceSoup &soup)
  {
    constexpr double by_rounding = 2e-6;
    merge_same(soup);
    if (soup.faces.empty() || !has_open_edge(soup))
      return;
    SurfaceSoup merged = soup;
    merge_close(merged, by_rounding * extent(soup.points).size().maxCoeff());
    if (!has_open_edge(merged) && !flat_triangle(merged))
      soup = std::move(merged);
  }

  std::optional<std::string> flaw_in(const SurfaceSoup &soup)
  {
    if (auto flaw = flat_triangle(soup))
      return flaw;
    if (auto flaw = edge_not_shared_by_two(soup))
      return flaw;
    return point_of_two_rings(soup);
  }

  void turn_over(SurfaceFace &face)
  {
    std::swap(face[1], face[2]);
    std::swap(face[3], face[5]);
  }

  std::optional<std::string> orient_alike(SurfaceSoup &soup, std::vector<unsigned int> &part_of_face)
  {
    constexpr unsigned int none  = -1;
    const auto             faces = faces_at_edges(soup);
    const auto             runs  = [&](const unsigned int f, const unsigned int a, const unsigned int b) {
      const auto &face = soup.faces[f];
      return (face[0] == a && face[1] == b) || (face[1] == a && face[2] == b) || (face[2] == a && face[0] == b);
    };
    part_of_face.assign(soup.faces.size(), none);
    unsigned int n_parts = 0;
    for (unsigned int start = 0; start < soup.faces.size(); ++start)
    {
      if (part_of_face[start] != none)
        continue;
      part_of_face[start] = n_parts++;
      for (std::deque<unsigned int> next{start}; !next.empty(); next.pop_front())
        for (int k = 0; k < 3; ++k)
        {
          const unsigned int f = next.front(), a = soup.faces[f][k], b = soup.faces[f][(k + 1) % 3];
          const auto        &both  = faces.at(edge_of(soup.faces[f], k));
          const unsigned int other = both[0] == f ? both[1] : both[0];
          if (part_of_face[other] == none)
          {
            if (runs(other, a, b))
              turn_over(soup.faces[other]);
            part_of_face[other] = part_of_face[f];
            next.push_back(other);
          }
          else if (runs(other, a, b))
            return fmt::format(
                "it has one side only, like a Moebius strip, as the edge {} shows; make it the surface of a "
                "solid",
                between(soup, edge_of(soup.faces[f], k)));
        }
    }
    return std::nullopt;
  }

  double winding_number(const std::vector<Vector3d> &points, const std::vector<std::array<unsigned int, 3>> &triangles,
                        const Vector3d &x)
  {
    // Solid angles: A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983), 125-126.
    double sum = 0.;
    for (const auto &triangle : triangles)
    {
      const Vector3d a = points[triangle[0]] - x, b = points[triangle[1]] - x, c = points[triangle[2]] - x;
      const double   la = a.norm(), lb = b.norm(), lc = c.norm();
      sum += 2. * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (4. * std::numbers::pi);
  }
} // namespace swimtwin
