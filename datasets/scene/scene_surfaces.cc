#include <datasets/scene/scene_surfaces.h>

#include <datasets/surface/elastic_part.h>
#include <datasets/surface/surface_distance.h>
#include <datasets/surface/surface_reader.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  using Eigen::Vector3d;

  namespace
  {
    template <typename T>
    T entry(const TomlDocument &document, const std::string &table, const std::string &key)
    {
      const toml::node *node = document.find(join_path(table, key));
      return node == nullptr ? T() : node->value_or<T>(T());
    }

    ClosedSurface read_surface_of(TomlDocument &document, const std::string &table, const std::filesystem::path &folder,
                                  const SurfaceUse use)
    {
      const std::filesystem::path named   = entry<std::string>(document, table, "surface");
      const std::string           stated  = entry<std::string>(document, table, "surface_sha256");
      ClosedSurface               surface = read_closed_surface(named.is_absolute() ? named : folder / named,
                                                  entry<double>(document, table, "surface_unit_m"), use);
      if (!stated.empty() && stated != surface.sha256)
        document.refuse(table, "surface",
                        "has changed since this scene was written; remove surface_sha256 to use the new content.");
      document.set_text(table, "surface_sha256", surface.sha256);
      return surface;
    }

    void shift(ClosedSurface &surface, const Vector3d &by)
    {
      for (Vector3d &x : surface.nodes)
        x += by;
    }

    void set_lengths(Tail &tail, const ClosedSurface &body, const ElasticPart &part)
    {
      std::vector<Vector3d> rim;
      for (const auto node : part.rim)
        rim.push_back(body.nodes[node]);
      const ClosedSurface closed = closed_part(body, part, true);
      const Extent        root   = extent(rim);
      tail.length_m              = extent(closed.nodes).high[0] - root.high[0];
      tail.root_height_m         = std::max(root.size()[1], root.size()[2]);
      // pi L (a^2 + a b + b^2) / 12 of a cone with the diameters a and b.
      const double a      = tail.root_height_m,
                   square = 12. * enclosed_volume(closed).volume_m3 / (std::numbers::pi * tail.length_m) - .75 * a * a;
      tail.tip_height_m   = std::max(.05 * a, std::sqrt(std::max(square, 0.)) - .5 * a);
    }

    /// A tail is the part of the body's surface that is named so.
    void read_body_surface(TomlDocument &document, const std::filesystem::path &folder, Scene &scene)
    {
      Head         &head    = scene.head;
      ClosedSurface surface = read_surface_of(document, "head", folder, SurfaceUse::body), rigid = surface;
      if (scene.tail)
      {
        const ElasticPart part = elastic_part(surface, "tail");
        set_lengths(*scene.tail, surface, part);
        scene.tail->part = std::make_shared<const ElasticPart>(part);
        rigid            = closed_part(surface, part, false);
      }
      EnclosedVolume enclosed = enclosed_volume(rigid);
      shift(surface, -enclosed.center_m);
      enclosed.center_m   = Vector3d::Zero();
      const Vector3d size = extent(rigid.nodes).size();
      head.size_m         = {size[0], std::max(size[1], size[2])};
      head.enclosed       = std::make_shared<const EnclosedVolume>(enclosed);
      head.surface        = std::make_shared<const ClosedSurface>(std::move(surface));
    }

    void read_walls_surface(TomlDocument &document, const std::filesystem::path &folder, Domain &domain)
    {
      ClosedSurface surface = read_surface_of(document, "domain", folder, SurfaceUse::walls);
      shift(surface, Vector3d(domain.center_m[0], domain.center_m[1], domain.center_z_m));
      const Vector3d size = extent(surface.nodes).size();
      domain.size_m       = {size[0], size[1]};
      domain.size_z_m     = size[2];
      domain.surface      = std::make_shared<const ClosedSurface>(std::move(surface));
    }

    std::string asymmetry(const ClosedSurface &surface, const std::string &whose)
    {
      constexpr double tolerance = 0.01;
      const double     distance  = distance_from_mirror_image(surface, 0.);
      if (distance <= tolerance * extent(surface.nodes).size().maxCoeff())
        return {};
      return fmt::format("{} surface is up to {:.3g} m away from its mirror image at z = 0", whose, distance);
    }
  } // namespace

  void declare_surface(TomlTable &table)
  {
    std::string file, digest;
    double      unit_m = 0.;
    table.text("surface", file);
    table.number("surface_unit_m", {"m", positive, Need::optional}, unit_m);
    table.text("surface_sha256", digest);
  }

  void read_surfaces(TomlDocument &document, const std::filesystem::path &folder, Scene &scene)
  {
    if (scene.head.shape == HeadShape::surface)
      read_body_surface(document, folder, scene);
    if (scene.domain && scene.domain->shape == DomainShape::surface)
      read_walls_surface(document, folder, *scene.domain);
  }

  std::string asymmetric_surface(const Scene &scene)
  {
    std::string reason;
    if (scene.head.surface)
      reason = asymmetry(*scene.head.surface, scene.tail ? "the body's" : "the head's");
    if (reason.empty() && scene.tail && scene.tail->part)
      reason = asymmetry(closed_part(*scene.head.surface, *scene.tail->part, true), "the tail's");
    if (reason.empty() && scene.domain && scene.domain->surface)
      reason = asymmetry(*scene.domain->surface, "the walls'");
    return reason;
  }

  std::vector<std::string> sliver_warnings(const Scene &scene)
  {
    constexpr double         least = 0.05;
    std::vector<std::string> warnings;
    for (const ClosedSurface *surface :
         {scene.head.surface.get(), scene.domain ? scene.domain->surface.get() : nullptr})
      if (const double worst = surface != nullptr ? triangle_sizes(*surface).worst_quality : 1.; worst < least)
        warnings.push_back(fmt::format(
            "{} has a triangle of quality {:.2g} (1: equilateral), and the mesh is made of its triangles: the "
            "flow is inaccurate at slivers below {}; mesh the surface anew",
            surface->file.filename().string(), worst, least));
    return warnings;
  }

  ClosedSurface surface_at_start(const Head &head)
  {
    ClosedSurface surface = *head.surface;
    const double  c = std::cos(head.angle_rad), s = std::sin(head.angle_rad);
    for (Vector3d &x : surface.nodes)
      x = Vector3d(head.center_m[0] + c * x[0] - s * x[1], head.center_m[1] + s * x[0] + c * x[1], x[2]);
    return surface;
  }
} // namespace swimtwin
