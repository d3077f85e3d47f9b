// Closed surfaces, and the files that hold them, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace swimtwin
{
  struct ExampleSurface
  {
    std::vector<std::array<double, 3>>     points;
    std::vector<std::vector<unsigned int>> faces; ///< of three or six points, outwards

    void add(const ExampleSurface &other)
    {
      const unsigned int n = points.size();
      points.insert(points.end(), other.points.begin(), other.points.end());
      for (auto face : other.faces)
      {
        for (auto &point : face)
          point += n;
        faces.push_back(face);
      }
    }
    ExampleSurface moved(const std::array<double, 3> &by) const
    {
      ExampleSurface copy = *this;
      for (auto &x : copy.points)
        for (int c = 0; c < 3; ++c)
          x[c] += by[c];
      return copy;
    }
  };

  /// The faces of a box around the origin, each side in n x n squares of two triangles.
  inline ExampleSurface example_box(const std::array<double, 3> &size, const int n = 1)
  {
    ExampleSurface                             box;
    std::map<std::array<int, 3>, unsigned int> number;
    const auto                                 at = [&](const std::array<int, 3> &place) {
      const auto [entry, is_new] = number.try_emplace(place, box.points.size());
      if (is_new)
        box.points.push_back(
                                            {size[0] * (place[0] - .5 * n) / n, size[1] * (place[1] - .5 * n) / n, size[2] * (place[2] - .5 * n) / n});
      return entry->second;
    };
    for (int axis = 0; axis < 3; ++axis)
      for (const int end : {0, n})
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
          {
            const auto corner = [&](const int di, const int dj) {
              std::array<int, 3> place{};
              place[axis]           = end;
              place[(axis + 1) % 3] = i + di;
              place[(axis + 2) % 3] = j + dj;
              return at(place);
            };
            const unsigned int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
            if (end == 0)
              box.faces.insert(box.faces.end(), {{a, c, b}, {a, d, c}});
            else
              box.faces.insert(box.faces.end(), {{a, b, c}, {a, c, d}});
          }
    return box;
  }

  /// A sphere around the origin: 20 * 4^n triangles, with middles on the sphere if they are curved.
  inline ExampleSurface example_sphere(const int n, const double radius, const bool is_curved)
  {
    const double   t = .5 * (1. + std::sqrt(5.));
    ExampleSurface sphere{{{-1, t, 0},
                           {1, t, 0},
                           {-1, -t, 0},
                           {1, -t, 0},
                           {0, -1, t},
                           {0, 1, t},
                           {0, -1, -t},
                           {0, 1, -t},
                           {t, 0, -1},
                           {t, 0, 1},
                           {-t, 0, -1},
                           {-t, 0, 1}},
                          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    const auto     on_sphere = [&](std::array<double, 3> x) {
      const double length = std::hypot(x[0], x[1], x[2]);
      for (double &c : x)
        c *= radius / length;
      return x;
    };
    for (auto &x : sphere.points)
      x = on_sphere(x);
    std::map<std::array<unsigned int, 2>, unsigned int> middles;
    const auto                                          middle = [&](const unsigned int a, const unsigned int b) {
      const auto [entry, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, sphere.points.size());
      if (is_new)
      {
        std::array<double, 3> x;
        for (int c = 0; c < 3; ++c)
          x[c] = .5 * (sphere.points[a][c] + sphere.points[b][c]);
        sphere.points.push_back(on_sphere(x));
      }
      return entry->second;
    };
    for (int k = 0; k < n; ++k)
    {
      std::vector<std::vector<unsigned int>> finer;
      middles.clear();
      for (const auto &f : sphere.faces)
      {
        const unsigned int ab = middle(f[0], f[1]), bc = middle(f[1], f[2]), ca = middle(f[2], f[0]);
        finer.insert(finer.end(), {{f[0], ab, ca}, {f[1], bc, ab}, {f[2], ca, bc}, {ab, bc, ca}});
      }
      sphere.faces = finer;
    }
    middles.clear();
    if (is_curved)
      for (auto &f : sphere.faces)
        f = {f[0], f[1], f[2], middle(f[0], f[1]), middle(f[1], f[2]), middle(f[2], f[0])};
    return sphere;
  }

  /// The triangles whose middle is to be in the tail come last; returns the number of the others.
  template <typename IsTail>
  std::size_t sort_tail_last(ExampleSurface &surface, const IsTail &is_tail)
  {
    const auto first = std::stable_partition(surface.faces.begin(), surface.faces.end(), [&](const auto &face) {
      std::array<double, 3> middle{};
      for (int v = 0; v < 3; ++v)
        for (int c = 0; c < 3; ++c)
          middle[c] += surface.points[face[v]][c] / 3.;
      return !is_tail(middle);
    });
    return static_cast<std::size_t>(first - surface.faces.begin());
  }

  inline std::string stl_text(const ExampleSurface &surface)
  {
    std::ostringstream text;
    text.precision(17);
    text << "solid made for a test\n";
    for (const auto &face : surface.faces)
    {
      text << "facet normal 0 0 0\n outer loop\n";
      for (int v = 0; v < 3; ++v)
      {
        const auto &x = surface.points[face[v]];
        text << "  vertex " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
      }
      text << " endloop\nendfacet\n";
    }
    text << "endsolid made for a test\n";
    return text.str();
  }

  inline std::string stl_bytes(const ExampleSurface &surface)
  {
    std::string bytes("solid, as some programs begin their bytes");
    const auto  append = [&](const auto value) {
      char raw[sizeof value];
      std::memcpy(raw, &value, sizeof value);
      bytes.append(raw, sizeof value);
    };
    bytes.resize(80, ' ');
    append(std::uint32_t(surface.faces.size()));
    for (const auto &face : surface.faces)
    {
      for (int c = 0; c < 3; ++c)
        append(0.f);
      for (int v = 0; v < 3; ++v)
        for (int c = 0; c < 3; ++c)
          append(float(surface.points[face[v]][c]));
      append(std::uint16_t(0));
    }
    return bytes;
  }

  /// gmsh's format 2.2 without physical names.
  inline std::string msh_text(const ExampleSurface &surface)
  {
    std::ostringstream text;
    text.precision(17);
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << surface.points.size() << '\n';
    for (std::size_t i = 0; i < surface.points.size(); ++i)
      text << i + 1 << ' ' << surface.points[i][0] << ' ' << surface.points[i][1] << ' ' << surface.points[i][2]
           << '\n';
    text << "$EndNodes\n$Elements\n" << surface.faces.size() << '\n';
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
    {
      text << f + 1 << (surface.faces[f].size() == 6 ? " 9" : " 2") << " 2 0 1";
      for (const auto point : surface.faces[f])
        text << ' ' << point + 1;
      text << '\n';
    }
    text << "$EndElements\n";
    return text.str();
  }

  /// Format 4.1; the triangles up to before `first_open` belong to the first physical surface, the others to the
  /// second.
  inline std::string msh41_text(const ExampleSurface &surface, const std::size_t first_open,
                                const std::array<std::string, 2> &names = {"sides", "open"})
  {
    std::ostringstream text;
    text.precision(17);
    const std::size_t n = surface.faces.size();
    text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 7 \"" << names[0] << "\"\n2 8 \"" << names[1]
         << "\"\n$EndPhysicalNames\n"
         << "$Entities\n1 0 2 0\n1 0 0 0 0\n1 -1 -1 -1 1 1 1 1 7 0\n2 -1 -1 -1 1 1 1 1 8 0\n$EndEntities\n"
         << "$Nodes\n1 " << surface.points.size() << " 1 " << surface.points.size() << "\n2 1 0 "
         << surface.points.size() << '\n';
    for (std::size_t i = 0; i < surface.points.size(); ++i)
      text << i + 1 << '\n';
    for (const auto &x : surface.points)
      text << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
    text << "$EndNodes\n$Elements\n3 " << n + 1 << " 1 " << n + 1 << "\n0 1 15 1\n" << n + 1 << " 1\n";
    for (const auto &[entity, first, last] :
         {std::array<std::size_t, 3>{1, 0, first_open}, std::array<std::size_t, 3>{2, first_open, n}})
    {
      text << "2 " << entity << (surface.faces[0].size() == 6 ? " 9 " : " 2 ") << last - first << '\n';
      for (std::size_t f = first; f < last; ++f)
      {
        text << f + 1;
        for (const auto point : surface.faces[f])
          text << ' ' << point + 1;
        text << '\n';
      }
    }
    text << "$EndElements\n";
    return text.str();
  }
} // namespace swimtwin
