#include <datasets/surface/surface_reader.h>

#include <datasets/files/input_file.h>
#include <datasets/surface/msh_reader.h>
#include <datasets/surface/stl_reader.h>
#include <datasets/surface/surface_crossings.h>
#include <datasets/surface/surface_topology.h>
#include <datasets/system/provenance.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace swimtwin
{
  using Eigen::Vector3d;

  namespace
  {
    SurfaceSoup read_soup(const std::filesystem::path &file, const std::string &content)
    {
      if (const auto foreign = foreign_content(content))
        refuse_file(file, "the surface", *foreign);
      if (content.starts_with("$MeshFormat"))
        return read_msh(file, content);
      const std::string ending = boost::algorithm::to_lower_copy(file.extension().string());
      if (ending == ".stl")
        return read_stl(file, content);
      refuse_file(file, "the surface",
                  ending == ".msh" ? "it is no file of gmsh, which begins with $MeshFormat; save the surface again"
                                   : "it is neither STL (.stl) nor a mesh of gmsh (.msh); convert it to one of them");
    }

    /// Straight edges have their middles in the middle.
    void add_middles(SurfaceSoup &soup)
    {
      std::map<std::array<unsigned int, 2>, unsigned int> middle;
      for (auto &face : soup.faces)
        for (int k = 0; k < 3; ++k)
        {
          const unsigned int a = face[k], b = face[(k + 1) % 3];
          const auto [entry, is_new] = middle.try_emplace({std::min(a, b), std::max(a, b)}, soup.points.size());
          if (is_new)
            soup.points.push_back(.5 * (soup.points[a] + soup.points[b]));
          face[3 + k] = entry->second;
        }
    }

    /// Every edge of curved triangles has one middle.
    std::optional<std::string> middles_that_differ(const SurfaceSoup &soup)
    {
      std::map<std::array<unsigned int, 2>, unsigned int> middle;
      std::size_t                                         n = 0;
      for (const auto &face : soup.faces)
        for (int k = 0; k < 3; ++k)
        {
          const unsigned int a = face[k], b = face[(k + 1) % 3];
          n += middle.try_emplace({std::min(a, b), std::max(a, b)}, face[3 + k]).first->second != face[3 + k];
        }
      if (n == 0)
        return std::nullopt;
      return fmt::format("at {} of its edges the triangles of order 2 on both sides have different middles; mesh it "
                         "again as one surface",
                         n);
    }

    /// Tetrahedra on slivers are slivers; gmsh seeks better ones without end.
    std::optional<std::string> slivers(const SurfaceSoup &soup)
    {
      constexpr double least = 0.005;
      std::size_t      n     = 0;
      double           worst = 1.;
      Vector3d         at    = Vector3d::Zero();
      for (const auto &face : soup.faces)
      {
        const double quality = triangle_quality(soup.points[face[0]], soup.points[face[1]], soup.points[face[2]]);
        n += quality < least;
        if (quality < worst)
        {
          worst = quality;
          at    = soup.points[face[0]];
        }
      }
      if (n == 0)
        return std::nullopt;
      return fmt::format(
          "{} of its {} triangles {} thinner than a mesh can be made of: quality {:.2g} (1: equilateral) "
          "at {}, at least {} is needed; remesh the surface (MeshLab: Isotropic Explicit Remeshing)",
          n, soup.faces.size(), n == 1 ? "is" : "are", worst, coordinates(at), least);
    }

    struct Parts
    {
      std::vector<std::vector<SurfaceFace>> faces;
      std::vector<Vector3d>                 point; ///< of each
    };

    Parts parts_of(const SurfaceSoup &soup, const std::vector<unsigned int> &part_of_face)
    {
      Parts parts;
      for (std::size_t f = 0; f < soup.faces.size(); ++f)
      {
        if (part_of_face[f] == parts.faces.size())
        {
          parts.faces.emplace_back();
          parts.point.push_back(soup.points[soup.faces[f][0]]);
        }
        parts.faces[part_of_face[f]].push_back(soup.faces[f]);
      }
      return parts;
    }

    double volume_of(const SurfaceSoup &soup, const std::vector<SurfaceFace> &faces)
    {
      ClosedSurface part;
      part.nodes = soup.points;
      part.faces = faces;
      return enclosed_volume(part).volume_m3;
    }

    /// Turn every part outwards, and those that stand in another one inwards.
    void turn_outwards(const std::filesystem::path &file, SurfaceSoup &soup, std::vector<unsigned int> &part_of_face,
                       const SurfaceUse use)
    {
      const auto refuse = [&](const std::string &cause) { refuse_file(file, "the surface", cause); };
      if (const auto flaw = orient_alike(soup, part_of_face))
        refuse(*flaw);
      const Parts       parts = parts_of(soup, part_of_face);
      const double      cube  = std::pow(extent(soup.points).size().maxCoeff(), 3);
      std::vector<char> turned;
      for (std::size_t p = 0; p < parts.faces.size(); ++p)
      {
        const double volume = volume_of(soup, parts.faces[p]);
        if (std::abs(volume) <= 1e-12 * cube)
          refuse(fmt::format("the part of it at {} encloses no volume; make it the surface of a solid",
                             coordinates(parts.point[p])));
        turned.push_back(volume < 0.);
      }
      std::size_t n_outer = 0;
      for (std::size_t p = 0; p < parts.faces.size(); ++p)
      {
        int depth = 0;
        for (std::size_t other = 0; other < parts.faces.size(); ++other)
          if (other != p)
            depth += std::abs(winding_number(soup.points, flat_triangles(parts.faces[other], soup.is_curved),
                                             parts.point[p])) > .5;
        if (depth > (use == SurfaceUse::walls ? 1 : 0))
          refuse(fmt::format("the part of it at {} is inside another one; {}", coordinates(parts.point[p]),
                             use == SurfaceUse::walls
                                 ? "fluid within an obstacle is not solved: remove that part"
                                 : "a body's cavities are not met by the fluid: remove that part"));
        if (depth == 1)
          turned[p] = !turned[p];
        n_outer += depth == 0;
      }
      if (use == SurfaceUse::walls && n_outer > 1)
        refuse(fmt::format("it bounds {} rooms that are apart; leave the one with the swimmer", n_outer));
      for (std::size_t f = 0; f < soup.faces.size(); ++f)
        if (turned[part_of_face[f]])
          turn_over(soup.faces[f]);
    }
  } // namespace

  ClosedSurface read_closed_surface(const std::filesystem::path &file, const double unit_m, const SurfaceUse use)
  {
    const std::string content = read_content(file, "the surface");
    SurfaceSoup       soup    = read_soup(file, content);
    const auto        refuse  = [&](const std::string &cause) { refuse_file(file, "the surface", cause); };
    if (soup.faces.empty())
      refuse("it holds no triangles; export the surface again");
    if (soup.faces.size() > n_faces_at_most)
      refuse(
          fmt::format("it has {} triangles, at most {} are possible; simplify it", soup.faces.size(), n_faces_at_most));
    merge_points(soup);
    if (const auto flaw = flaw_in(soup))
      refuse(*flaw);
    if (const auto flaw = slivers(soup))
      refuse(*flaw);
    if (const auto flaw = soup.is_curved ? middles_that_differ(soup) : std::nullopt)
      refuse(*flaw);
    if (const auto found = self_crossings(soup.points, flat_triangles(soup.faces, soup.is_curved)); found.n_pairs > 0)
      refuse(fmt::format("it goes through itself: {} of triangles cross, the first near {}; mend it (MeshLab: Remove "
                         "Self Intersecting Faces, then Close Holes)",
                         found.n_pairs == 1 ? "1 pair" : fmt::format("{} pairs", found.n_pairs),
                         coordinates(found.first)));
    if (!soup.is_curved)
      add_middles(soup);
    std::vector<unsigned int> part_of_face;
    turn_outwards(file, soup, part_of_face, use);

    ClosedSurface surface;
    surface.file          = file;
    surface.sha256        = digest(content);
    surface.nodes         = std::move(soup.points);
    surface.faces         = std::move(soup.faces);
    surface.is_curved     = soup.is_curved;
    surface.patches       = std::move(soup.patches);
    surface.patch_of_face = std::move(soup.patch_of_face);
    for (auto &x : surface.nodes)
      x *= unit_m;
    return surface;
  }
} // namespace swimtwin
