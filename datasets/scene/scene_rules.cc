#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/mesh_rules.h>
#include <datasets/scene/mirror_plane.h>
#include <datasets/scene/scene_names.h>
#include <datasets/scene/scene_rules.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/scene/surface_units.h>
#include <datasets/scene/swimmer_clearance.h>
#include <datasets/scene/tail_rules.h>
#include <datasets/text/toml_document.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int    steps_per_period_min = 10;
    constexpr double n_steps_max          = 1e9;

    bool has(const TomlDocument &document, const std::string &table, const std::string &key)
    {
      return document.find(join_path(table, key)) != nullptr;
    }

    void need_entry(const TomlDocument &document, const std::string &table, const std::string &key,
                    const std::string &reason)
    {
      if (!has(document, table, key))
        document.refuse(table, key, fmt::format("is missing; {}.", reason));
    }

    void refuse_entry(const TomlDocument &document, const std::string &table, const std::string &key,
                      const std::string &reason)
    {
      if (has(document, table, key))
        document.refuse(table, key, reason);
    }

    /// Of [head] and [domain].
    void check_surface_entries(const TomlDocument &document, const std::string &table, const bool is_surface,
                               const std::string &shape)
    {
      if (is_surface)
      {
        need_entry(document, table, "surface",
                   "the shape surface needs the file of a closed surface, .stl or .msh, relative to the scene");
        return need_entry(document, table, "surface_unit_m",
                          "the shape surface needs it: how many metres the file's unit of length is, 1e-3 for mm");
      }
      for (const char *key : {"surface", "surface_unit_m", "surface_sha256"})
        refuse_entry(document, table, key,
                     fmt::format("does not belong to the shape {}; remove it, or set shape = \"surface\".", shape));
    }

    /// A tail is the part of the surface that is named so.
    void check_surface_tail(const TomlDocument &document, const Tail &tail)
    {
      for (const char *key : {"length_m", "root_height_m", "tip_height_m", "profile_m", "section", "width_m", "tip"})
        refuse_entry(document, "tail", key,
                     "does not belong to a tail that is part of the head's surface, which has its shape; remove it.");
      if (tail.is_driven())
        document.refuse("tail", "law",
                        "cannot be \"prescribed\" of a tail that is part of the head's surface; use an elastic law, or "
                        "a head and a tail that are known by their shapes.");
    }

    /// The triangles of a body that is read from a surface are the mesh there.
    void check_surface_head(const TomlDocument &document)
    {
      const std::string not_needed = "does not belong to the shape surface, which has its size; remove it.";
      for (const char *key : {"size_m", "diameter_m"})
        refuse_entry(document, "head", key, not_needed);
      for (const char *key : {"mesh_size_m", "mesh_size_corner_m"})
        refuse_entry(
            document, "numerics", key,
            "does not go with a body that is read from a surface, whose triangles are the mesh there; remove it, "
            "and mesh the surface finer or coarser.");
    }

    void check_head_entries(const TomlDocument &document, const Head &head, const int dimension)
    {
      const bool is_surface = head.shape == HeadShape::surface;
      check_surface_entries(document, "head", is_surface, std::string(name_of(head.shape, dimension)));
      if (is_surface)
        return check_surface_head(document);
      const bool        disc  = head.shape == HeadShape::disc;
      const std::string other = disc ? "size_m" : "diameter_m", needed = disc ? "diameter_m" : "size_m";
      const std::string shape(name_of(head.shape, dimension));
      refuse_entry(document, "head", other, fmt::format("does not belong to the shape {}; give {}.", shape, needed));
      need_entry(document, "head", needed, fmt::format("the shape {} needs it, in m", shape));
      constexpr double thinnest = 1e-6;
      if (const auto [thin, thick] = std::minmax(head.size_m[0], head.size_m[1]); !disc && thin < thinnest * thick)
        document.refuse("head", "size_m",
                        fmt::format("m is too thin to be meshed: one side needs {} of the other at least.", thinnest));
    }

    void check_domain_entries(const TomlDocument &document, const Domain &domain)
    {
      const bool straight = domain.shape == DomainShape::box || domain.shape == DomainShape::channel;
      const bool annulus  = domain.shape == DomainShape::annulus;
      const auto check    = [&](const std::string &key, const bool belongs) {
        const std::string shape(to_string(domain.shape));
        if (belongs)
          need_entry(document, "domain", key, fmt::format("the shape {} needs it, in m", shape));
        else
          refuse_entry(document, "domain", key, fmt::format("does not belong to the shape {}; remove it.", shape));
      };
      const bool is_surface = domain.shape == DomainShape::surface;
      check_surface_entries(document, "domain", is_surface, std::string(to_string(domain.shape)));
      check("size_m", straight);
      check("length_m", domain.shape == DomainShape::cylinder);
      check("radius_m", !straight && !is_surface);
      check("inner_radius_m", annulus);
      if (annulus && domain.inner_radius_m >= domain.radius_m)
        document.refuse(
            "domain", "inner_radius_m",
            fmt::format("m is not smaller than radius_m = {} m; the fluid is between both circles.", domain.radius_m));
    }

    void check_parts(const TomlDocument &document, const Scene &scene)
    {
      if (scene.fluid && !scene.domain)
        document.refuse("fluid", "", "needs a [domain] that the fluid fills; add it, or remove [fluid].");
      if (scene.domain && !scene.fluid)
        document.refuse("domain", "", "needs a [fluid] that fills it; add it, or remove [domain].");
      if (!scene.fluid && !scene.tail)
        document.refuse("head", "", "is rigid and alone, so there is nothing to solve; add a [fluid] or a [tail].");
      if (!scene.fluid && scene.head.is_free())
        document.refuse("head", "motion",
                        has(document, "head", "motion")
                            ? "has nothing to hold the head without a [fluid]; set it to \"fixed\", or add a [fluid]."
                            : "must be \"fixed\" without a [fluid], because nothing else holds the head.");
      if (scene.head.is_free())
        need_entry(document, "head", "density_kg_m3", "a free head needs it, in kg/m^3");
    }

    void check_inertia(const TomlDocument &document, const Scene &scene)
    {
      if (scene.fluid)
        refuse_entry(document, "tail", "inertia", "is for a tail without [fluid]; write [fluid] inertia instead.");
      if (scene.is_partitioned() && inertia_terms(scene).any())
        document.refuse(
            "numerics", "coupling",
            "cannot be \"fixed-point\" with inertia: where the fluid is as heavy as the body that iteration "
            "does not converge; use \"monolithic\", or [fluid] inertia = \"none\".");
    }

    void check_plane(const TomlDocument &document, const Scene &scene)
    {
      refuse_entry(document, "head", "magnetization_direction",
                   "is for three dimensions: a head in the plane is magnetised along its +x; remove it, or use "
                   "dimension = 3.");
      if (!scene.field.leaves_plane())
        return;
      const bool is_program = has(document, "field", "program");
      document.refuse(
          "field", is_program ? "program" : "bz_T",
          fmt::format("{}, which turns the swimmer out of the plane; set bz_T to zero, or use dimension = 3.",
                      is_program ? "has values of bz_T that are not zero" : "is not zero"));
    }

    void check_space(const TomlDocument &document, const Scene &scene)
    {
      if (scene.dimension != 3)
        return check_plane(document, scene);
      if (scene.numerics.mirror_meshes)
        document.refuse("numerics", "mirror_meshes", "is for two dimensions; remove it.");
    }

    /// What a shape or a head that is given does not go with.
    void check_given_motion(const TomlDocument &document, const Scene &scene)
    {
      const bool has_given_shape = scene.tail && scene.tail->is_driven();
      if (has_given_shape && !scene.fluid)
        document.refuse("tail", "law",
                        "cannot be \"prescribed\" without a [fluid]: there is nothing to solve; add a [fluid].");
      if (has_given_shape && !scene.domain->has_traction_free_wall())
        document.refuse(
            "tail", "law",
            "cannot be \"prescribed\" in a domain without a traction-free wall, whose fluid leaves no room for "
            "what a meshed shape changes of its area; make a wall \"traction-free\".");
      if (has_given_shape && scene.numerics.tail_order == 1)
        document.refuse("numerics", "tail_order", "of 1 is for an elastic tail; leave it out.");
      if (scene.is_partitioned() && scene.head.is_driven())
        document.refuse("numerics", "coupling",
                        "cannot be \"fixed-point\" with a prescribed motion of the head; use \"monolithic\".");
    }

    void check_steady(const TomlDocument &document, const Scene &scene)
    {
      if (!scene.time.is_steady)
        return;
      if (scene.head.motion != HeadMotion::fixed || (scene.tail && scene.tail->is_driven()))
        document.refuse("time", "steady", "is for a head that is fixed; set [head] motion = \"fixed\", or remove it.");
      if (scene.field.waveform() != FieldProgram::Waveform::none)
        document.refuse("time", "steady", "does not go with a [field], which changes in time; remove one of them.");
    }

    void check_coupling(const TomlDocument &document, const Scene &scene)
    {
      if (scene.is_partitioned() && !scene.domain->has_traction_free_wall())
        document.refuse(
            "numerics", "coupling",
            "cannot be \"fixed-point\" in a domain without a traction-free wall: the shape rate it gives the "
            "fluid changes the tail's area, and the closed fluid's volume cannot change; use \"monolithic\".");
    }

    void check_symmetry(const TomlDocument &document, const Scene &scene)
    {
      if (scene.numerics.symmetric_half != SymmetricHalf::on)
        return;
      if (const MirrorPlane plane = find_mirror_plane(scene); !plane.exists())
        document.refuse(
            "numerics", "symmetric_half",
            fmt::format("needs a scene that is its own mirror image, but {}; use \"auto\" or \"off\".", plane.missing));
      if (scene.is_partitioned())
        document.refuse("numerics", "symmetric_half",
                        "does not go with coupling = \"fixed-point\", which solves the whole scene; use \"off\", or "
                        "coupling = \"monolithic\".");
    }

    void check_wall(const TomlDocument &document, const Domain &domain, const std::string &name, const Wall &wall)
    {
      const std::string path     = "domain.walls." + name;
      const bool        straight = domain.shape == DomainShape::box || domain.shape == DomainShape::channel;
      const bool        inflow   = wall.condition == WallCondition::inflow;
      if (inflow && !straight)
        document.refuse("domain.walls", name,
                        "cannot be an inflow; inflows need a straight wall of a box or a channel.");
      if (wall.condition == WallCondition::moving_wall && domain.shape == DomainShape::surface)
        document.refuse("domain.walls", name,
                        "cannot be a moving wall where walls are read from a surface; use \"no-slip\", "
                        "\"traction-free\" or \"shear-flow\".");
      if (wall.condition == WallCondition::shear_flow)
      {
        if (!has(document, path, "shear_rate_1_s"))
          document.refuse(
              "domain.walls", name,
              fmt::format("has no rate; write {} = {{ condition = \"shear-flow\", shear_rate_1_s = ... }}.", name));
      }
      else
        refuse_entry(document, path, "shear_rate_1_s", "belongs to a shear flow only; remove it.");
      if (inflow || wall.condition == WallCondition::moving_wall)
      {
        if (!has(document, path, "speed_m_s"))
          document.refuse("domain.walls", name,
                          fmt::format("has no speed; write {} = {{ condition = \"{}\", speed_m_s = ... }}.", name,
                                      to_string(wall.condition)));
      }
      else
      {
        const std::string reason = fmt::format("does not belong to a {} wall; remove it.", to_string(wall.condition));
        refuse_entry(document, path, "speed_m_s", reason);
        if (wall.condition != WallCondition::shear_flow)
          refuse_entry(document, path, "ramp_s", reason);
      }
      if (!inflow)
        refuse_entry(document, path, "profile", "belongs to an inflow only; remove it.");
    }

    void check_inflow_has_outflow(const TomlDocument &document, const Domain &domain)
    {
      const auto find = [&](const WallCondition condition) {
        return std::find_if(domain.walls.begin(), domain.walls.end(),
                            [&](const auto &entry) { return entry.second.condition == condition; });
      };
      const auto inflow = find(WallCondition::inflow);
      if (inflow != domain.walls.end() && find(WallCondition::traction_free) == domain.walls.end())
        document.refuse("domain.walls", inflow->first,
                        "is an inflow, but the fluid cannot leave; make at least one other wall \"traction-free\".");
    }

    void check_moving_domain(const TomlDocument &document, const Scene &scene)
    {
      const Domain &domain = *scene.domain;
      if (!domain.moves_with_swimmer)
        return;
      if (domain.shape != DomainShape::disc && domain.shape != DomainShape::sphere)
        document.refuse("domain", "moves_with_swimmer",
                        fmt::format("is for the shape {0} only; remove it, or use a {0}.",
                                    scene.dimension == 3 ? "sphere" : "disc"));
      const WallCondition outer = domain.walls.at("outer").condition;
      if (outer != WallCondition::no_slip && outer != WallCondition::shear_flow)
        document.refuse("domain", "moves_with_swimmer",
                        "needs a no-slip outer wall, or a shear flow; set [domain.walls] outer = \"no-slip\".");
      if (outer == WallCondition::shear_flow && inertia_terms(scene).of_fluid())
        document.refuse(
            "domain", "moves_with_swimmer",
            "does not go with a shear flow that has inertia; set [fluid] inertia = \"none\", or remove it.");
    }

    void check_fluid_is_held(const TomlDocument &document, const Scene &scene)
    {
      const InertiaTerms terms = inertia_terms(scene);
      if (!scene.domain->has_holding_wall() && scene.head.is_free() && !terms.unsteady && !terms.of_body())
        document.refuse(
            "domain", "walls",
            "leaves every wall traction-free: without inertia nothing keeps fluid and "
            "swimmer from moving along together; make one of them \"no-slip\", or set [fluid] inertia = \"full\".");
    }

    void check_walls(const TomlDocument &document, const Scene &scene)
    {
      const Domain &domain = *scene.domain;
      for (const auto &[name, wall] : domain.walls)
        check_wall(document, domain, name, wall);
      check_inflow_has_outflow(document, domain);
      check_moving_domain(document, scene);
      check_fluid_is_held(document, scene);
    }

    void check_clearance(const TomlDocument &document, const Scene &scene)
    {
      const Clearance clearance = swimmer_clearance(scene);
      // In space a narrower gap is filled with tetrahedra of its width for ever.
      constexpr double narrowest = 5e-4; // body lengths
      // round-off of a body that is placed exactly on a wall
      if (clearance.distance_m > 1e-9 * scene.body_length_m())
      {
        if (scene.dimension == 3 && clearance.distance_m < narrowest * scene.body_length_m())
          document.refuse("domain", "",
                          fmt::format("leaves {:.2g} m between the swimmer and the {} wall, too narrow a gap to be "
                                      "meshed in space; {:.2g} m are needed, a 2000th of the body's length: enlarge "
                                      "the domain, or move the head.",
                                      clearance.distance_m, clearance.wall, narrowest * scene.body_length_m()));
        return;
      }
      const std::string verb = clearance.distance_m < -1e-9 * scene.body_length_m()
                                   ? fmt::format("reaches {:.4g} m beyond", -clearance.distance_m)
                                   : std::string("touches");
      document.refuse(
          "domain", "",
          fmt::format("does not contain the swimmer, which {} the {} wall; enlarge the domain, or move the head.", verb,
                      clearance.wall));
    }

    void check_time(const TomlDocument &document, const Scene &scene)
    {
      const TimeSettings &time = scene.time;
      if (scene.field.period_s() > 0. && time.steps_per_period < steps_per_period_min)
        document.refuse("time", "steps_per_period",
                        fmt::format("gives {} steps per half swing; at least {} steps per period are needed.",
                                    0.5 * time.steps_per_period, steps_per_period_min));
      const double n_steps = time.periods * time.steps_per_period;
      if (n_steps > n_steps_max)
        document.refuse("time", "periods",
                        fmt::format("gives {:.3g} steps; at most {:.0e} are possible.", n_steps, n_steps_max));
      if (std::abs(n_steps - std::round(n_steps)) > 1e-9 * n_steps)
        document.refuse("time", "periods",
                        fmt::format("of {} steps gives {:.6g} steps; choose a whole number of steps.",
                                    time.steps_per_period, n_steps));
    }
  } // namespace

  void check_dimension(const TomlDocument &document, const int dimension)
  {
    if (dimension != 2 && dimension != 3)
      document.refuse("", "dimension", "is not a space that swimmers live in; use 2 or 3.");
  }

  void check_shape_entries(const TomlDocument &document, const Scene &scene)
  {
    check_head_entries(document, scene.head, scene.dimension);
    if (scene.tail && scene.head.shape == HeadShape::surface)
      check_surface_tail(document, *scene.tail);
    else if (scene.tail)
      check_tail_entries(document, scene);
    if (scene.domain)
      check_domain_entries(document, *scene.domain);
  }

  void check_field_entries(const TomlDocument &document)
  {
    if (has(document, "field", "program"))
    {
      for (const char *key : {"waveform", "bx_T", "by_T", "bz_T", "bz_phase_rad", "frequency_Hz"})
        refuse_entry(document, "field", key,
                     "does not go with a program, which gives the whole field; remove one of both.");
      return need_entry(
          document, "field", "period_s",
          "a program needs the period after which it repeats, in s, here or in NAME.json beside NAME.csv");
    }
    for (const char *key : {"period_s", "program_sha256"})
      refuse_entry(document, "field", key, "goes with a program only; remove it, or add program = \"file.csv\".");
    for (const char *key : {"bx_T", "by_T"})
      need_entry(document, "field", key, "give both components of the field, in T");
    if (!has(document, "field", "bz_T"))
      refuse_entry(document, "field", "bz_phase_rad",
                   "is the phase of bz_T, which is missing; add it, or remove this.");

    const toml::node *waveform = document.find("field.waveform");
    const std::string word     = waveform == nullptr ? "sinusoidal" : waveform->value_or<std::string>("");
    if (word == to_string(FieldProgram::Waveform::sinusoidal))
      need_entry(document, "field", "frequency_Hz", "a sinusoidal field needs it, in Hz");
    else if (word == to_string(FieldProgram::Waveform::constant))
      for (const char *key : {"frequency_Hz", "bz_phase_rad"})
        refuse_entry(document, "field", key, "does not belong to a constant field; remove it.");
    else
      document.refuse("field", "waveform",
                      "cannot be chosen here; use \"sinusoidal\" or \"constant\", give a program, or "
                      "leave [field] out.");
  }

  void check_motion_entries(const TomlDocument &document, const Scene &scene)
  {
    const auto belongs = [&](const std::string &parent, const std::string &table, const bool is_asked_for,
                             const std::string &switch_on) {
      if (is_asked_for && !has(document, parent, table))
        document.refuse(parent, table, fmt::format("is missing; {} needs its motion.", switch_on));
      if (!is_asked_for && has(document, parent, table))
        document.refuse(parent, table, fmt::format("is not used; set {}, or remove it.", switch_on));
    };
    belongs("head", "oscillation", scene.head.is_driven(), "[head] motion = \"prescribed\"");
    if (scene.tail)
      belongs("tail", "wave", scene.tail->is_driven(), "[tail] law = \"prescribed\"");
  }

  void check_time_entries(const TomlDocument &document, const bool is_periodic, const bool is_steady)
  {
    if (is_steady)
    {
      for (const char *key : {"duration_s", "steps", "periods", "steps_per_period"})
        refuse_entry(document, "time", key, "does not go with steady = true; remove one of them.");
      return;
    }
    const std::string reason = is_periodic
                                   ? "does not go with a periodic field or motion; give periods and steps_per_period."
                                   : "needs a periodic field or motion; give duration_s and steps.";
    for (const char *key : {"duration_s", "steps"})
      if (is_periodic)
        refuse_entry(document, "time", key, reason);
      else
        need_entry(document, "time", key,
                   "without a periodic field or motion give duration_s in s and the number of steps");
    for (const char *key : {"periods", "steps_per_period"})
      if (!is_periodic)
        refuse_entry(document, "time", key, reason);
      else
        need_entry(document, "time", key, "with a periodic field or motion give periods and steps_per_period");
  }

  void check_scene(const TomlDocument &document, const Scene &scene)
  {
    check_parts(document, scene);
    check_inertia(document, scene);
    check_steady(document, scene);
    check_given_motion(document, scene);
    check_space(document, scene);
    if (scene.tail && !scene.tail->part)
      check_tail(document, scene);
    if (scene.domain)
    {
      check_walls(document, scene);
      check_coupling(document, scene);
      check_surface_units(document, scene);
      check_clearance(document, scene);
    }
    check_symmetry(document, scene);
    check_time(document, scene);
    check_mesh(document, scene);
  }
} // namespace swimtwin
