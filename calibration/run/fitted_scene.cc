#include <calibration/run/fitted_scene.h>

#include <datasets/scene/field_period.h>
#include <datasets/scene/field_program_writer.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/scene_field.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    using Overrides = std::vector<std::string>;

    void set(Overrides &overrides, const char *key, const double value)
    {
      overrides.push_back(fmt::format("{}={:.17g}", key, value));
    }

    void set(Overrides &overrides, const char *key, const std::array<double, 2> &pair, const double scale)
    {
      overrides.push_back(fmt::format("{}=[{:.17g}, {:.17g}]", key, scale * pair[0], scale * pair[1]));
    }

    Overrides physics(const CalibratedSwimmer &swimmer)
    {
      Overrides overrides;
      set(overrides, "tail.young_modulus_Pa", swimmer.young_modulus_Pa);
      set(overrides, "fluid.viscosity_Pa_s", swimmer.viscosity_Pa_s);
      set(overrides, "head.magnetization_A_m", swimmer.magnetization_A_m);
      return overrides;
    }

    void set_field(Overrides &overrides, const FieldProgram &field, const double scale)
    {
      set(overrides, "field.bx_T", scale * field.bx_T());
      set(overrides, "field.by_T", scale * field.by_T());
    }

    void set_tail_shape(Overrides &overrides, const Tail &tail, const double scale)
    {
      if (tail.profile_m.empty())
      {
        set(overrides, "tail.length_m", scale * tail.length_m);
        set(overrides, "tail.root_height_m", scale * tail.root_height_m);
        set(overrides, "tail.tip_height_m", scale * tail.tip_height_m);
        return;
      }
      std::vector<std::string> points;
      for (const auto &[x, half_height] : tail.profile_m)
        points.push_back(fmt::format("[{:.17g}, {:.17g}]", scale * x, scale * half_height));
      overrides.push_back(fmt::format("tail.profile_m=[{}]", fmt::join(points, ", ")));
    }

    void set_lengths(Overrides &overrides, const Scene &scene, const double scale)
    {
      const auto &[head, tail, domain] = std::tie(scene.head, scene.tail, scene.domain);
      if (head.shape == HeadShape::disc)
        set(overrides, "head.diameter_m", scale * head.size_m[0]);
      else
        set(overrides, "head.size_m", head.size_m, scale);
      set(overrides, "head.center_m", head.center_m, scale);
      set_tail_shape(overrides, *tail, scale);
      set(overrides, "domain.center_m", domain->center_m, scale);
      const bool straight = domain->shape == DomainShape::box || domain->shape == DomainShape::channel;
      if (straight)
        set(overrides, "domain.size_m", domain->size_m, scale);
      else
        set(overrides, "domain.radius_m", scale * domain->radius_m);
      if (domain->shape == DomainShape::annulus)
        set(overrides, "domain.inner_radius_m", scale * domain->inner_radius_m);
      set(overrides, "numerics.mesh_size_m", scale * scene.numerics.mesh_size_m);
      set(overrides, "numerics.mesh_size_corner_m", scale * scene.numerics.mesh_size_corner_m);
      set(overrides, "numerics.mesh_size_far_m", scale * scene.numerics.mesh_size_far_m);
    }

    FieldProgram scaled(const FieldProgram &field, const double scale)
    {
      std::vector<std::array<double, 3>> b_T = field.b_T();
      for (auto &b : b_T)
        for (double &component : b)
          component *= scale;
      return FieldProgram::sampled(field.time_s(), std::move(b_T), field.period_s());
    }

    bool is_sinusoidal(const FieldProgram &field)
    {
      return field.waveform() == FieldProgram::Waveform::sinusoidal;
    }
  } // namespace

  Scene fitted_scene(const ReducedModel &model, const CalibratedSwimmer &swimmer, const InertiaTerms &carried,
                     const ObservationSet &data, const std::filesystem::path &folder)
  {
    const std::filesystem::path program   = folder / fitted_field_name;
    const Scene                 scene     = parse_scene(model.scene_text, model.scene_name + ".toml");
    std::string                 text      = model.scene_text;
    Overrides                   overrides = physics(swimmer);
    overrides.push_back(inertia_override(names_of(carried)));
    if (is_sinusoidal(data.field))
    {
      set_field(overrides, data.field, swimmer.field_scale);
      std::filesystem::remove(program);
      std::filesystem::remove(period_file(program));
    }
    else
    {
      const FieldProgram field = field_at(data, 1. / scene.field.period_s());
      write_field_program(program, scaled(field, swimmer.field_scale),
                          fmt::format("Field of {} times the fitted scale {:.6g}, at the frequency of {}", data.name,
                                      swimmer.field_scale, model.scene_name));
      text = with_field_program(text, fitted_field_name, field.period_s());
    }
    if (swimmer.geometry_scale != 1.)
      set_lengths(overrides, scene, swimmer.geometry_scale);
    return parse_scene(text, folder / fitted_scene_name, overrides);
  }

  void require_repeatable(const std::vector<ObservationSet> &sets)
  {
    for (const ObservationSet &set : sets)
      if (!is_sinusoidal(set.field) || !set.period)
        throw InputError(fmt::format("{} is {}, which the full-order runs of --verify and --refine do not repeat; they "
                                     "take a numbered period in a sinusoidal field: leave them out.",
                                     set.file.string(), set.period ? "in a sampled field" : "of the periodic state"));
  }

  Scene scene_of_observation(const ReducedModel &model, const CalibratedSwimmer &swimmer, const InertiaTerms &carried,
                             const FieldProgram &field, const std::optional<int> period)
  {
    Overrides overrides = physics(swimmer);
    set_field(overrides, field, swimmer.field_scale);
    set(overrides, "field.frequency_Hz", 1. / field.period_s());
    overrides.push_back(fmt::format("time.periods={}", period.value()));
    overrides.push_back("output.snapshots_per_period=30"); // to refine the model with
    overrides.push_back(
        inertia_override(names_of(carried))); // like the reduced swimmer, whose other errors are looked for
    return parse_scene(model.scene_text, model.scene_name + ".toml", overrides);
  }
} // namespace swimtwin
