#include <datasets/scene/scene_parts.h>
#include <datasets/scene/scene_rules.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <datasets/text/text_decoding.h>

namespace swimtwin
{
  namespace
  {
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
