// The fluid, and the domain that it fills.
#include <datasets/scene/scene_parts.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/surface/closed_surface.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    /// A word for all terms, or a list of them.
    void read_inertia(TomlTable &table, FluidProperties &fluid)
    {
      if (!table.is_array("inertia"))
        return read_choice(table, "inertia", fluid.inertia);
      fluid.inertia = Inertia::chosen;
      std::vector<std::string> known, chosen;
      for (const auto &[name, term] : inertia_term_names)
        known.emplace_back(name);
      table.words("inertia", Need::optional, known, chosen);
      for (const auto &[name, term] : inertia_term_names)
        fluid.chosen.*term = std::find(chosen.begin(), chosen.end(), name) != chosen.end();
    }

    std::vector<std::string> wall_names(const Domain &domain, const int dimension)
    {
      const DomainShape shape = domain.shape;
      if (domain.surface)
        return domain.surface->patches;
      if (shape == DomainShape::sphere)
        return {"outer"};
      if (shape == DomainShape::cylinder)
        return {"left", "right", "outer"};
      if (dimension == 3)
        return {"left", "right", "bottom", "top", "front", "back"};
      if (shape == DomainShape::disc)
        return {"outer"};
      if (shape == DomainShape::annulus)
        return {"outer", "inner"};
      return {"left", "right", "bottom", "top"};
    }

    Wall default_wall(const DomainShape shape, const std::string &name)
    {
      Wall       wall;
      const bool is_open = shape == DomainShape::channel || shape == DomainShape::cylinder;
      if (is_open && (name == "left" || name == "right"))
        wall.condition = WallCondition::traction_free;
      return wall;
    }

    /// A condition alone, `left = "no-slip"`, or a table with its parameters.
    void read_wall(const TomlDocument &document, TomlTable &walls, const std::string &name, Wall &wall)
    {
      const std::string path = "domain.walls." + name;
      const toml::node *node = document.find(path);
      if (node == nullptr || !node->is_table())
        return read_choice(walls, name, wall.condition);
      walls.table(name);
      TomlTable table(document, path);
      read_choice(table, "condition", wall.condition, Need::required);
      table.number("speed_m_s", optional("m/s", any_number), wall.speed_m_s);
      table.number("shear_rate_1_s", optional("1/s", any_number), wall.shear_rate_1_s);
      read_choice(table, "profile", wall.profile);
      table.number("ramp_s", optional("s", not_negative), wall.ramp_s);
      table.finish();
    }
  } // namespace

  std::array<double, 3> read_center(TomlTable &table, const int dimension)
  {
    const NumberRule      rule = optional("m", any_number);
    std::array<double, 3> center{};
    if (dimension == 3 && table.array_size("center_m") == 3)
      table.triple("center_m", rule, center);
    else
    {
      std::array<double, 2> in_plane{};
      table.pair("center_m", rule, in_plane);
      center = {in_plane[0], in_plane[1], 0.};
    }
    return center;
  }

  std::optional<FluidProperties> read_fluid(const TomlDocument &document)
  {
    TomlTable       table(document, "fluid");
    FluidProperties fluid;
    table.number("density_kg_m3", required("kg/m^3"), fluid.density_kg_m3);
    table.number("viscosity_Pa_s", required("Pa s"), fluid.viscosity_Pa_s);
    read_inertia(table, fluid);
    table.finish();
    return table.present() ? std::optional(fluid) : std::nullopt;
  }

  std::map<std::string, Wall> read_walls(const TomlDocument &document, const Domain &domain, const int dimension)
  {
    std::map<std::string, Wall> walls;
    TomlTable                   table(document, "domain.walls");
    for (const std::string &name : wall_names(domain, dimension))
    {
      walls[name] = default_wall(domain.shape, name);
      read_wall(document, table, name, walls[name]);
    }
    table.finish();
    return walls;
  }

  std::optional<Domain> read_domain(const TomlDocument &document, const int dimension)
  {
    TomlTable             table(document, "domain");
    Domain                domain;
    std::array<double, 3> size_m{0., 0., 0.};
    if (dimension == 3)
      table.choice("shape", Need::required, domain_shapes_in_space, domain.shape);
    else
      table.choice("shape", Need::required, domain_shapes_in_plane, domain.shape);
    const auto center = read_center(table, dimension);
    domain.center_m   = {center[0], center[1]};
    domain.center_z_m = center[2];
    if (dimension == 3)
    {
      table.triple("size_m", optional("m"), size_m);
      table.number("length_m", optional("m"), size_m[0]);
      domain.size_m   = {size_m[0], size_m[1]};
      domain.size_z_m = size_m[2];
    }
    else
      table.pair("size_m", optional("m"), domain.size_m);
    table.number("radius_m", optional("m"), domain.radius_m);
    table.number("inner_radius_m", optional("m"), domain.inner_radius_m);
    declare_surface(table);
    table.flag("moves_with_swimmer", domain.moves_with_swimmer);
    table.table("walls");
    table.finish();
    if (domain.center_z_m != 0. && domain.shape != DomainShape::surface)
      document.refuse(
          "domain", "center_m",
          "is off the plane z = 0, in which walls that are known by their shape are mirrored; leave out the "
          "third number, or read the walls from a surface.");
    return table.present() ? std::optional(domain) : std::nullopt;
  }
} // namespace swimtwin
