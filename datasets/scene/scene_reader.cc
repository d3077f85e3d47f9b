#include <datasets/text/csv_table.h>
#include <datasets/system/error.h>
#include <datasets/scene/field_period.h>
#include <datasets/system/provenance.h>
#include <datasets/scene/scene.h>
#include <datasets/scene/scene_names.h>
#include <datasets/scene/scene_rules.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/surface/closed_surface.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/toml_table.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr NumberRule required(const std::string_view unit, const Range &range = positive)
    {
      return {unit, range, Need::required};
    }
    constexpr NumberRule optional(const std::string_view unit, const Range &range = positive)
    {
      return {unit, range, Need::optional};
    }

    constexpr Range poisson_range{-1., 0.5, true, true, "lie between -1 and 0.5, both excluded"};
    constexpr Range tolerance_range{0., 1., true, true, "lie between 0 and 1, both excluded"};
    constexpr Range quality_range{0., 1., false, true, "be at least 0 and less than 1"};
    constexpr Range order_range{1., 2., false, false, "be 1 or 2"};
    constexpr Range growth_range{0., 1., true, false, "be positive and at most 1"};
    constexpr Range relaxation_range{0., 1., true, false, "lie between 0, excluded, and 1"};
    constexpr Range halvings_range{0., 20., false, false, "lie between 0 and 20"};

    template <typename Enum>
    void read_choice(TomlTable &table, const std::string &key, Enum &target, const Need need = Need::optional)
    {
      table.choice(key, need, Names<Enum>::list, target);
    }

    int read_top_level(const TomlDocument &document)
    {
      int       dimension = 0;
      TomlTable table(document, "");
      table.integer("dimension", required("", any_number), dimension);
      for (const char *name : {"fluid", "domain", "head", "tail", "field", "gravity", "time", "numerics", "output"})
        table.table(name);
      table.finish();
      return dimension;
    }

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
      table.pair("center_m", optional("m", any_number), domain.center_m);
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
      return table.present() ? std::optional(domain) : std::nullopt;
    }

    HeadOscillation read_oscillation(const TomlDocument &document)
    {
      TomlTable       table(document, "head.oscillation");
      HeadOscillation oscillation;
      table.pair("amplitude_m", optional("m", any_number), oscillation.amplitude_m);
      table.number("angle_rad", optional("rad", any_number), oscillation.angle_rad);
      table.number("frequency_Hz", required("Hz"), oscillation.frequency_Hz);
      table.number("phase_rad", optional("rad", any_number), oscillation.phase_rad);
      table.finish();
      return oscillation;
    }

    TailWave read_wave(const TomlDocument &document)
    {
      TomlTable table(document, "tail.wave");
      TailWave  wave;
      table.number("angle_rad", required("rad", any_number), wave.angle_rad);
      table.number("frequency_Hz", required("Hz"), wave.frequency_Hz);
      table.number("waves", optional("", any_number), wave.waves);
      table.number("phase_rad", optional("rad", any_number), wave.phase_rad);
      table.finish();
      return wave;
    }

    Head read_head(const TomlDocument &document, const int dimension)
    {
      if (document.find("head") == nullptr)
        throw InputError(document.where("") + ": the table [head] is missing; every swimmer has a rigid head.");
      TomlTable table(document, "head");
      Head      head;
      double    diameter_m = 0.;
      table.choice("shape", Need::required, head_shapes(dimension), head.shape);
      table.pair("size_m", optional("m"), head.size_m);
      table.number("diameter_m", optional("m"), diameter_m);
      declare_surface(table);
      table.pair("center_m", optional("m", any_number), head.center_m);
      table.number("angle_rad", optional("rad", any_number), head.angle_rad);
      table.number("density_kg_m3", optional("kg/m^3"), head.density_kg_m3);
      table.number("magnetization_A_m", optional("A/m", any_number), head.magnetization_A_m);
      table.triple("magnetization_direction", optional("", any_number), head.magnetization_direction);
      table.number("young_modulus_Pa", optional("Pa"), head.young_modulus_Pa);
      table.number("poisson_ratio", optional("", poisson_range), head.poisson_ratio);
      read_choice(table, "motion", head.motion);
      table.table("oscillation");
      table.finish();
      if (head.shape == HeadShape::disc)
        head.size_m = {diameter_m, diameter_m};
      head.oscillation    = read_oscillation(document);
      auto &[x, y, z]     = head.magnetization_direction;
      const double length = std::hypot(x, y, z);
      if (length == 0.)
        document.refuse("head", "magnetization_direction", "has no direction; give a vector such as [0.0, 1.0, 0.0].");
      head.magnetization_direction = {x / length, y / length, z / length};
      return head;
    }

    /// Straight sides, or points that they go through; from these follow the three lengths of straight ones.
    void read_tail_shape(TomlTable &table, const bool is_in_surface, Tail &tail)
    {
      read_choice(table, "section", tail.section);
      table.number("width_m", optional("m"), tail.width_m);
      if (tail.section == TailSection::rectangular)
        tail.tip = TipShape::flat;
      read_choice(table, "tip", tail.tip);
      table.pairs("profile_m", optional("m", not_negative), tail.profile_m);
      const Need lengths = is_in_surface || table.has("profile_m") ? Need::optional : Need::required;
      table.number("length_m", {"m", positive, lengths}, tail.length_m);
      table.number("root_height_m", {"m", positive, lengths}, tail.root_height_m);
      table.number("tip_height_m", {"m", positive, lengths}, tail.tip_height_m);
      if (tail.profile_m.empty())
        return;
      const auto &[end, end_half_height] = tail.profile_m.back();
      tail.root_height_m                 = 2. * tail.profile_m.front()[1];
      tail.tip_height_m                  = 2. * end_half_height;
      tail.length_m                      = end + (tail.tip == TipShape::rounded ? end_half_height : 0.);
    }

    std::optional<Tail> read_tail(const TomlDocument &document, const Head &head)
    {
      TomlTable table(document, "tail");
      Tail      tail;
      read_tail_shape(table, head.shape == HeadShape::surface, tail);
      read_choice(table, "law", tail.law);
      const Need moduli = tail.is_elastic() ? Need::required : Need::optional;
      table.number("young_modulus_Pa", {"Pa", positive, moduli}, tail.young_modulus_Pa);
      table.number("poisson_ratio", {"", poisson_range, moduli}, tail.poisson_ratio);
      table.number("density_kg_m3", required("kg/m^3"), tail.density_kg_m3);
      table.number("magnetization_A_m", optional("A/m", any_number), tail.magnetization_A_m);
      Inertia in_vacuum = Inertia::none;
      read_choice(table, "inertia", in_vacuum);
      tail.has_inertia_in_vacuum = in_vacuum == Inertia::full;
      table.table("wave");
      table.finish();
      tail.wave = read_wave(document);
      return table.present() ? std::optional(tail) : std::nullopt;
    }

    /// A relative path of a field program is relative to the scene file.
    std::filesystem::path program_path(const std::string &program, const std::filesystem::path &folder)
    {
      return std::filesystem::path(program).is_absolute() ? std::filesystem::path(program) : folder / program;
    }

    /// From the file beside the program into the scene, which has to say by itself what was played; 0 without one.
    double take_over_stated_period(TomlDocument &document, const std::filesystem::path &program)
    {
      const std::optional<double> period_s = stated_period_s(program);
      if (period_s)
        document.set_number("field", "period_s", *period_s);
      return period_s.value_or(0.);
    }

    FieldProgram read_field(TomlDocument &document, const std::filesystem::path &folder)
    {
      TomlTable              table(document, "field");
      FieldProgram::Waveform waveform = FieldProgram::Waveform::sinusoidal;
      double                 bx_T = 0., by_T = 0., frequency_Hz = 0., period_s = 0., ramp_s = 0.;
      FieldAlongZ            along_z;
      std::string            program, program_digest;
      read_choice(table, "waveform", waveform);
      table.number("bx_T", optional("T", any_number), bx_T);
      table.number("by_T", optional("T", any_number), by_T);
      table.number("bz_T", optional("T", any_number), along_z.bz_T);
      table.number("bz_phase_rad", optional("rad", any_number), along_z.phase_rad);
      table.number("frequency_Hz", optional("Hz"), frequency_Hz);
      table.text("program", program);
      table.text("program_sha256", program_digest);
      table.number("period_s", optional("s"), period_s);
      table.number("ramp_s", optional("s", not_negative), ramp_s);
      table.finish();
      if (!table.present())
        return {};
      const std::filesystem::path file = program_path(program, folder);
      if (table.has("program") && !table.has("period_s"))
        period_s = take_over_stated_period(document, file);
      check_field_entries(document);

      FieldProgram field;
      if (table.has("program"))
      {
        const std::string actual = digest(read_text_file(file, "the field program"));
        if (!program_digest.empty() && program_digest != actual)
          document.refuse("field", "program",
                          "has changed since this scene was written; remove program_sha256 to use the new content.");
        document.set_text("field", "program_sha256", actual);
        field = FieldProgram::read_csv(file, period_s);
      }
      else if (waveform == FieldProgram::Waveform::constant)
        field = FieldProgram::constant(bx_T, by_T, along_z.bz_T);
      else
        field = FieldProgram::sinusoidal(bx_T, by_T, frequency_Hz, along_z);
      field.ramp_s = ramp_s;
      return field;
    }

    Gravity read_gravity(const TomlDocument &document, const int dimension)
    {
      TomlTable  table(document, "gravity");
      Gravity    gravity;
      auto      &g    = gravity.acceleration_m_s2;
      const auto rule = required("m/s^2", any_number);
      if (dimension == 3 && table.array_size("acceleration_m_s2") != 2) // two: no component along z
        table.triple("acceleration_m_s2", rule, g);
      else
      {
        std::array<double, 2> in_plane{};
        table.pair("acceleration_m_s2", rule, in_plane);
        g = {in_plane[0], in_plane[1], 0.};
      }
      table.number("ramp_s", optional("s", not_negative), gravity.ramp_s);
      table.finish();
      return gravity;
    }

    /// Period of what drives the scene: of its field, or of a prescribed motion; 0 without either.
    double driven_period_s(const Scene &scene)
    {
      if (scene.field.period_s() > 0.)
        return scene.field.period_s();
      if (scene.tail && scene.tail->is_driven())
        return 1. / scene.tail->wave.frequency_Hz;
      return scene.head.is_driven() ? 1. / scene.head.oscillation.frequency_Hz : 0.;
    }

    TimeSettings read_time(const TomlDocument &document, const double period_s)
    {
      if (document.find("time") == nullptr)
        throw InputError(document.where("") + ": the table [time] is missing; it says how long to simulate.");
      TomlTable    table(document, "time");
      TimeSettings time;
      double       duration_s = 0.;
      int          steps      = 0;
      table.number("periods", optional(""), time.periods);
      table.integer("steps_per_period", optional("", at_least_one), time.steps_per_period);
      table.number("duration_s", optional("s"), duration_s);
      table.integer("steps", optional("", at_least_one), steps);
      table.flag("steady", time.is_steady);
      table.finish();
      check_time_entries(document, period_s > 0., time.is_steady);
      if (time.is_steady)
        return {.period_s = 1., .periods = 1., .steps_per_period = 1, .is_steady = true};
      if (period_s > 0.)
        time.period_s = period_s;
      else
        time = {duration_s, 1., steps};
      return time;
    }

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

    Numerics read_numerics(const TomlDocument &document, const Scene &scene)
    {
      TomlTable table(document, "numerics");
      Numerics  numerics;
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
      if (numerics.coupling == CouplingScheme::fixed_point)
        numerics.max_coupling_iterations = 200;
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

    /// Loads and walls of a steady scene are what they are after all ramps.
    void end_ramps(Scene &scene)
    {
      scene.gravity.ramp_s = 0.;
      if (scene.domain)
        for (auto &[name, wall] : scene.domain->walls)
          wall.ramp_s = 0.;
    }

    OutputSettings read_output(const TomlDocument &document)
    {
      TomlTable      table(document, "output");
      OutputSettings output;
      table.integer("snapshots_per_period", optional("", not_negative), output.snapshots_per_period);
      table.integer("fields_per_period", optional("", not_negative), output.fields_per_period);
      table.finish();
      return output;
    }
  } // namespace

  Scene parse_scene(const std::string_view text, const std::string &name, const std::vector<std::string> &overrides)
  {
    TomlDocument document(text, name, overrides);
    document.apply_variant();
    Scene scene;
    scene.name      = std::filesystem::path(name).stem().string();
    scene.dimension = read_top_level(document);
    check_dimension(document, scene.dimension);
    scene.fluid  = read_fluid(document);
    scene.domain = read_domain(document, scene.dimension);
    scene.head   = read_head(document, scene.dimension);
    scene.tail   = read_tail(document, scene.head);
    check_shape_entries(document, scene);
    check_motion_entries(document, scene);
    read_surfaces(document, std::filesystem::path(name).parent_path(), scene);
    if (scene.domain)
      scene.domain->walls = read_walls(document, *scene.domain, scene.dimension);
    scene.field    = read_field(document, std::filesystem::path(name).parent_path());
    scene.gravity  = read_gravity(document, scene.dimension);
    scene.time     = read_time(document, driven_period_s(scene));
    scene.numerics = read_numerics(document, scene);
    scene.output   = read_output(document);
    if (scene.time.is_steady)
      end_ramps(scene);
    check_scene(document, scene);
    scene.text = document.text();
    scene.hash = digest(scene.text);
    return scene;
  }

  Scene read_scene(const std::filesystem::path &file, const std::vector<std::string> &overrides)
  {
    return parse_scene(read_decoded_text(file, "the scene"), file.string(), overrides);
  }
} // namespace swimtwin
