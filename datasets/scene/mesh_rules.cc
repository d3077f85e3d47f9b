#include <datasets/scene/mesh_rules.h>
#include <datasets/text/toml_document.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    void check_mesh_sizes(const TomlDocument &document, const Numerics &numerics)
    {
      if (numerics.mesh_size_corner_m > numerics.mesh_size_m)
        document.refuse(
            "numerics", document.find("numerics.mesh_size_corner_m") != nullptr ? "mesh_size_corner_m" : "mesh_size_m",
            fmt::format("m: the mesh size at corners ({} m) is larger than on the surface ({} m); reduce it.",
                        numerics.mesh_size_corner_m, numerics.mesh_size_m));
      if (numerics.mesh_size_far_m < numerics.mesh_size_m)
        document.refuse(
            "numerics", document.find("numerics.mesh_size_far_m") != nullptr ? "mesh_size_far_m" : "mesh_size_m",
            fmt::format("m: the mesh size far away ({} m) is smaller than on the surface ({} m); enlarge it.",
                        numerics.mesh_size_far_m, numerics.mesh_size_m));
    }

    const double triangle    = 0.25 * std::sqrt(3.); ///< area of one of equal sides, over the square of a side
    const double tetrahedron = std::sqrt(2.) / 12.;  ///< volume of one of equal edges, over the cube of an edge

    /// Along x, y and, in space, z.
    std::array<double, 3> extent_m(const Domain &domain)
    {
      const double diameter = 2. * domain.radius_m;
      if (domain.shape == DomainShape::cylinder)
        return {domain.size_m[0], diameter, diameter};
      return diameter > 0. ? std::array{diameter, diameter, diameter}
                           : std::array{domain.size_m[0], domain.size_m[1], domain.size_z_m};
    }

    /// About as many triangles as the fluid's mesh would have: of equal sides, which grow with the distance from the
    /// body.
    double expected_triangles(const Scene &scene)
    {
      const Numerics &sizes  = scene.numerics;
      const auto [x, y, z]   = extent_m(*scene.domain);
      const double area      = x * y;
      const double perimeter = 2. * (scene.body_length_m() + scene.head.size_m[1]);
      const double near =
          std::min(perimeter / (sizes.mesh_growth * sizes.mesh_size_m), area / (sizes.mesh_size_m * sizes.mesh_size_m));
      return (near + area / (sizes.mesh_size_far_m * sizes.mesh_size_far_m)) / triangle;
    }

    /// The same of tetrahedra: as many per volume as have the wanted edge.
    double expected_tetrahedra(const Scene &scene)
    {
      const Numerics &sizes = scene.numerics;
      const auto [x, y, z]  = extent_m(*scene.domain);
      const double volume = x * y * z, h = sizes.mesh_size_m, far = sizes.mesh_size_far_m;
      const double perimeter = std::numbers::pi * scene.head.size_m[1];
      const double near =
          std::min(scene.body_length_m() * perimeter / (2. * sizes.mesh_growth * h * h), volume / (h * h * h));
      return (near + volume / (far * far * far)) / tetrahedron;
    }

    void check_mesh_extent(const TomlDocument &document, const Scene &scene)
    {
      const bool       in_space = scene.dimension == 3;
      const double     n_most   = in_space ? 3e6 : 1e7; // no machine has the memory for more
      constexpr double longest  = 1e6;                  // body lengths: beyond, coordinates of the body are round-off
      if (!scene.domain)
        return;
      const auto [x, y, z] = extent_m(*scene.domain);
      if (const double extent = std::max({x, y, z}) / scene.body_length_m(); extent > longest)
        document.refuse("domain", "",
                        fmt::format("is {:.3g} body lengths long; at most {:.0e} are possible.", extent, longest));
      if (const double n = expected_cells(scene); !(n <= n_most))
        document.refuse("numerics",
                        document.find("numerics.mesh_size_far_m") != nullptr ? "mesh_size_far_m" : "mesh_size_m",
                        fmt::format("m would make a mesh of about {:.1g} {}; at most {:.0e} are possible: "
                                    "enlarge mesh_size_m, mesh_size_far_m or mesh_growth, or make [domain] smaller.",
                                    n, in_space ? "tetrahedra" : "triangles", n_most));
    }
  } // namespace

  double expected_cells(const Scene &scene)
  {
    if (!scene.domain)
      return 0.;
    return scene.dimension == 3 ? expected_tetrahedra(scene) : expected_triangles(scene);
  }

  double expected_body_cells(const Scene &scene)
  {
    const double h = scene.numerics.mesh_size_m, length = scene.tail ? scene.tail->length_m : 0.;
    const double height = scene.tail ? scene.tail->mean_height_m() : 0.;
    if (scene.dimension == 2)
      return length * height / (triangle * h * h);
    const bool   is_film = scene.tail && scene.tail->section == TailSection::rectangular;
    const double section = is_film ? scene.tail->width_m * height : .25 * std::numbers::pi * height * height;
    const auto   head    = scene.head.size_m;
    return length * section / (tetrahedron * h * h * h) +
           std::numbers::pi * head[1] * (head[0] + .5 * head[1]) / (triangle * h * h);
  }

  void check_mesh(const TomlDocument &document, const Scene &scene)
  {
    check_mesh_sizes(document, scene.numerics);
    check_mesh_extent(document, scene);
  }
} // namespace swimtwin
