#include <datasets/surface/elastic_part.h>

#include <datasets/files/input_file.h>
#include <datasets/surface/surface_topology.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace swimtwin
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr double plane_tolerance = 1e-5; ///< of the body's extent

    [[noreturn]] void refuse(const ClosedSurface &body, const std::string &cause)
    {
      refuse_file(body.file, "the surface", cause);
    }

    std::vector<char> faces_of_patch(const ClosedSurface &body, const std::string &patch)
    {
      const auto found = std::find(body.patches.begin(), body.patches.end(), patch);
      if (found == body.patches.end())
        refuse(body,
               fmt::format("it has no physical surface named \"{0}\", only \"{1}\"; name the elastic part of the body "
                           "so (in gmsh: Physical Surface(\"{0}\") = {{...}};), or leave [tail] out",
                           patch, fmt::join(body.patches, "\", \"")));
      const auto        number = static_cast<unsigned int>(found - body.patches.begin());
      std::vector<char> has_face;
      for (const auto p : body.patch_of_face)
        has_face.push_back(p == number);
      if (std::all_of(has_face.begin(), has_face.end(), [](const char is_own) { return is_own; }))
        refuse(body,
               fmt::format("all of it is \"{}\"; leave a part of it, the head, to another physical surface", patch));
      return has_face;
    }

    /// From a vertex of the rim along its edge, as the elastic faces run: the edge's middle and its end.
    using RimEdges = std::map<unsigned int, std::array<unsigned int, 2>>;

    RimEdges edges_between(const ClosedSurface &body, const std::vector<char> &has_face)
    {
      std::map<std::array<unsigned int, 2>, int> n_elastic;
      for (std::size_t f = 0; f < body.faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
        {
          const unsigned int a = body.faces[f][k], b = body.faces[f][(k + 1) % 3];
          n_elastic[{std::min(a, b), std::max(a, b)}] += has_face[f];
        }
      RimEdges edges;
      for (std::size_t f = 0; f < body.faces.size(); ++f)
        for (int k = 0; has_face[f] && k < 3; ++k)
        {
          const unsigned int a = body.faces[f][k], b = body.faces[f][(k + 1) % 3];
          if (n_elastic.at({std::min(a, b), std::max(a, b)}) == 1 &&
              !edges.try_emplace(a, std::array{body.faces[f][3 + k], b}).second)
            refuse(body, "the rim of its elastic part touches itself; part the body at one closed curve");
        }
      return edges;
    }

    std::vector<unsigned int> loop_along(const ClosedSurface &body, const RimEdges &edges, const std::string &patch)
    {
      if (edges.empty())
        refuse(body, fmt::format("\"{}\" is a piece of its own, which nothing holds; join it to the head", patch));
      std::vector<unsigned int> loop;
      unsigned int              vertex = edges.begin()->first;
      do
      {
        const auto &[middle, end] = edges.at(vertex);
        loop.insert(loop.end(), {vertex, middle});
        vertex = end;
      } while (vertex != loop.front());
      if (loop.size() != 2 * edges.size())
        refuse(body, fmt::format("\"{}\" has several rims; part the body at one closed curve", patch));
      return loop;
    }

    unsigned int n_pieces(const ClosedSurface &surface)
    {
      SurfaceSoup               soup{surface.nodes, surface.faces, surface.is_curved, {}, {}};
      std::vector<unsigned int> piece_of_face;
      orient_alike(soup, piece_of_face);
      return 1 + *std::max_element(piece_of_face.begin(), piece_of_face.end());
    }

    Vector3d mean_of(const ClosedSurface &body, const std::vector<unsigned int> &nodes)
    {
      Vector3d mean = Vector3d::Zero();
      for (const auto node : nodes)
        mean += body.nodes[node] / static_cast<double>(nodes.size());
      return mean;
    }

    void require_plane_across_x(const ClosedSurface &body, const ElasticPart &part, const std::string &patch)
    {
      const double   length = extent(body.nodes).size().maxCoeff();
      const Vector3d middle = mean_of(body, part.rim);
      double         out    = 0.;
      for (const auto node : part.rim)
        out = std::max(out, std::abs(body.nodes[node][0] - middle[0]));
      if (out > plane_tolerance * length)
        refuse(body, fmt::format("the rim of \"{}\" leaves the plane across x by {:.3g} m; part the body where x is "
                                 "the same all around",
                                 patch, out));
      double behind = 0.;
      for (std::size_t f = 0; f < body.faces.size(); ++f)
        for (int k = 0; part.has_face[f] && k < 3; ++k)
          behind += body.nodes[body.faces[f][k]][0] - middle[0];
      if (!(behind > 0.))
        refuse(body, fmt::format("\"{}\" lies before its rim; turn the body so that the tail points along +x", patch));
    }
  } // namespace

  ElasticPart elastic_part(const ClosedSurface &body, const std::string &patch)
  {
    ElasticPart part;
    part.has_face = faces_of_patch(body, patch);
    part.rim      = loop_along(body, edges_between(body, part.has_face), patch);
    if (n_pieces(closed_part(body, part, true)) > 1)
      refuse(body, fmt::format("\"{}\" has a piece of its own, which nothing holds; join it to the head", patch));
    require_plane_across_x(body, part, patch);
    return part;
  }

  ClosedSurface closed_part(const ClosedSurface &body, const ElasticPart &part, const bool is_elastic)
  {
    ClosedSurface                        closed;
    std::map<unsigned int, unsigned int> number;
    const auto                           own = [&](const unsigned int node) {
      const auto [entry, is_new] = number.try_emplace(node, closed.nodes.size());
      if (is_new)
        closed.nodes.push_back(body.nodes[node]);
      return entry->second;
    };
    closed.file      = body.file;
    closed.is_curved = body.is_curved;
    for (std::size_t f = 0; f < body.faces.size(); ++f)
      if ((part.has_face[f] != 0) == is_elastic)
      {
        auto &face = closed.faces.emplace_back();
        for (std::size_t k = 0; k < face.size(); ++k)
          face[k] = own(body.faces[f][k]);
      }
    // A fan around the middle of the rim: of triangles with signs, if that does not see all of it.
    const auto     center = static_cast<unsigned int>(closed.nodes.size());
    const Vector3d middle = mean_of(body, part.rim);
    closed.nodes.push_back(middle);
    const std::size_t n      = part.rim.size() / 2;
    const auto        first  = static_cast<unsigned int>(closed.nodes.size());
    const auto        vertex = [&](const std::size_t i) { return own(part.rim[2 * (i % n)]); };
    for (std::size_t i = 0; i < n; ++i)
      closed.nodes.push_back(.5 * (middle + closed.nodes[vertex(i)]));
    for (std::size_t i = 0; i < n; ++i)
    {
      // The elastic faces run along the rim, so that what closes them runs against it.
      const unsigned int a = vertex(i), b = vertex(i + 1), ab = own(part.rim[2 * i + 1]),
                         ca = first + static_cast<unsigned int>(i), bc = first + static_cast<unsigned int>((i + 1) % n);
      closed.faces.push_back(is_elastic ? SurfaceFace{b, a, center, ab, ca, bc}
                                        : SurfaceFace{a, b, center, ab, bc, ca});
    }
    closed.patches = {"outer"};
    closed.patch_of_face.assign(closed.faces.size(), 0);
    return closed;
  }
} // namespace swimtwin
