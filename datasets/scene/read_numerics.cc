// Meshes, solvers and coupling.
#include <datasets/scene/scene_parts.h>
#include <datasets/surface/closed_surface.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr Range tolerance_range{0., 1., true, true, "lie between 0 and 1, both excluded"};
    constexpr Range quality_range{0., 1., false, true, "be at least 0 and less than 1"};
    constexpr Range order_range{1., 2., false, false, "be 1 or 2"};
    constexpr Range growth_range{0., 1., true, false, "be positive and at most 1"};
    constexpr Range relaxation_range{0., 1., true, false, "lie between 0, excluded, and 1"};
    constexpr Range halvings_range{0., 20., false, false, "lie between 0 and 20"};

    double smallest_extent_m(const Domain &domain)
    {
      if (domain.shape == DomainShape::cylinder)
        return std::min(domain.size_m[0], 2. * domain.radius_m);
      if (domain.shape == DomainShape::disc || domain.shape == DomainShape::annulus ||
          domain.shape == DomainShape::sphere)
        return domain.inner_radius_m > 0. ? domain.radius_m - domain.inner_radius_m : 2. * domain.radius_m;
      const double smallest = std::min(domain.size_m[0], domain.size_m[1]);
      return domain.size_z_m > 0. ? std::min(smallest, domain.size_z_m) : smallest;
    }

    void set_default_sizes_on_body(const Scene &scene, const TomlTable &table, Numerics &numerics)
    {
      if (!table.has("mesh_size_m"))
        numerics.mesh_size_m = scene.body_length_m() / (scene.dimension == 3 ? 20. : 60.);
      if (!table.has("mesh_size_corner_m"))
        numerics.mesh_size_corner_m = numerics.mesh_size_m / (scene.dimension == 3 ? 2. : 4.);
    }

    /// Where they are not what they are in the plane: tetrahedra are worse at their best, and factors dearer.
    Numerics numerics_in_space()
    {
      Numerics numerics;
      numerics.mesh_growth         = 0.5;
      numerics.remesh_quality      = 0.02;
      numerics.reuse_factorization = true;
      return numerics;
    }

    /// Mesh sizes of a scene that gives none: 60 elements along the body (20 in space), 4 times finer at corners
    /// (twice), 8 across the domain. A body that is read from a surface has the sizes of its triangles.
    void set_default_mesh_sizes(const Scene &scene, const TomlTable &table, Numerics &numerics)
    {
      if (scene.head.surface)
        numerics.mesh_size_m = numerics.mesh_size_corner_m = triangle_sizes(*scene.head.surface).mean_edge_m;
      else
        set_default_sizes_on_body(scene, table, numerics);
      if (!table.has("mesh_size_far_m"))
        numerics.mesh_size_far_m =
            std::max(numerics.mesh_size_m, scene.domain ? smallest_extent_m(*scene.domain) / 8. : 0.);
    }
  } // namespace

  Numerics read_numerics(const TomlDocument &document, const Scene &scene)
  {
    TomlTable table(document, "numerics");
    Numerics  numerics = scene.dimension == 3 ? numerics_in_space() : Numerics{};
    table.number("mesh_size_m", optional("m"), numerics.mesh_size_m);
    table.number("mesh_size_corner_m", optional("m", not_negative), numerics.mesh_size_corner_m);
    table.number("mesh_size_far_m", optional("m"), numerics.mesh_size_far_m);
    table.number("mesh_growth", optional("", growth_range), numerics.mesh_growth);
    table.integer("tail_order", optional("", order_range), numerics.tail_order);
    table.flag("mirror_meshes", numerics.mirror_meshes);
    read_choice(table, "symmetric_half", numerics.symmetric_half);
    read_choice(table, "mesh_motion", numerics.mesh_motion);
    table.number("remesh_quality", optional("", quality_range), numerics.remesh_quality);
    table.integer("remesh_every_steps", optional("", not_negative), numerics.remesh_every_steps);
    read_choice(table, "coupling", numerics.coupling);
    table.number("coupling_tolerance", optional("", tolerance_range), numerics.coupling_tolerance);
    if (numerics.coupling == CouplingScheme::fixed_point && scene.can_be_partitioned())
    {
      numerics.max_coupling_iterations = 200;
      numerics.reuse_factorization     = false; // the baseline's factors are made anew
    }
    table.integer("max_coupling_iterations", optional("", at_least_one), numerics.max_coupling_iterations);
    read_choice(table, "acceleration", numerics.acceleration);
    table.number("relaxation", optional("", relaxation_range), numerics.relaxation);
    table.integer("iqn_reused_steps", optional("", not_negative), numerics.iqn_reused_steps);
    read_choice(table, "linear_solver", numerics.linear_solver);
    table.number("linear_tolerance", optional("", tolerance_range), numerics.linear_tolerance);
    table.flag("reuse_factorization", numerics.reuse_factorization);
    table.integer("max_step_halvings", optional("", halvings_range), numerics.max_step_halvings);
    table.finish();
    set_default_mesh_sizes(scene, table, numerics);
    return numerics;
  }
} // namespace swimtwin
