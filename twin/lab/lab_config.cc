#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/mirror_plane.h>
#include <datasets/scene/scene.h>
#include <datasets/system/error.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/toml_table.h>
#include <rom/swimmer/carried_inertia.h>
#include <twin/lab/lab_config.h>
#include <twin/motion/inertia_entry.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr Range part_of_all{0., 1., false, true, "be at least 0 and below 1"};
    constexpr Range any_factor{0., infinity, true, false, "be a positive factor"};

    /// The viscosity becomes the nominal one, which inertia is compared with; the ratios stay those of the scene.
    void read_lab_swimmer(const TomlDocument &document, SwimmerParameters &nominal, TwinParameters &truth)
    {
      SwimmerParameters values = nominal;
      TomlTable         table(document, "swimmer");
      table.number("young_modulus_Pa", {"Pa", positive}, values.young_modulus_Pa);
      table.number("viscosity_Pa_s", {"Pa s", positive}, values.viscosity_Pa_s);
      table.number("magnetization_A_m", {"A/m", positive}, values.magnetization_A_m);
      table.number("background_bx_T", {"T", any_number}, truth[TwinParameter::background_x].value);
      table.number("background_by_T", {"T", any_number}, truth[TwinParameter::background_y].value);
      table.number("flow_x_m_s", {"m/s", any_number}, truth[TwinParameter::flow_x].value);
      table.number("flow_y_m_s", {"m/s", any_number}, truth[TwinParameter::flow_y].value);
      table.finish();
      truth[TwinParameter::stiffness].value =
          std::log(values.young_modulus_Pa / values.viscosity_Pa_s * nominal.viscosity_Pa_s / nominal.young_modulus_Pa);
      truth[TwinParameter::magnetization].value = std::log(values.magnetization_A_m / values.viscosity_Pa_s *
                                                           nominal.viscosity_Pa_s / nominal.magnetization_A_m);
      const double thicker                      = values.viscosity_Pa_s / nominal.viscosity_Pa_s;
      nominal.viscosity_Pa_s *= thicker;
      nominal.young_modulus_Pa *= thicker;
      nominal.magnetization_A_m *= thicker;
      nominal.tail_magnetization_A_m *= thicker;
    }

    void read_spans(TomlTable &table, const std::string &name, std::vector<TimeSpan> &spans)
    {
      for (int i = 1; table.has(fmt::format("{}_{}_s", name, i)); ++i)
      {
        std::array<double, 2> span{};
        const std::string     key = fmt::format("{}_{}_s", name, i);
        table.pair(key, {"s", any_number}, span);
        if (!(span[1] > span[0]))
          table.note(key, "ends before it begins; give [from, to].");
        spans.push_back({span[0], span[1]});
      }
    }

    void read_lab_camera(const TomlDocument &document, const double length_m, LabConfig &config)
    {
      LaboratoryCamera &camera = config.options.camera;
      TwinParameters   &truth  = config.options.truth;
      double            scale = 1., position = 0.003, angle_rad = 0.0175, outlier = 0.5;
      TomlTable         table(document, "camera");
      table.number("frames_per_second", {"1/s", positive}, camera.frames_per_second);
      table.number("position_noise", {"body lengths", not_negative}, position);
      table.number("angle_noise_rad", {"rad", not_negative}, angle_rad);
      table.flag("sees_angle", camera.sees_angle);
      bool sees_tip = false;
      table.flag("sees_tip", sees_tip);
      table.flag("tells_sigmas", config.tells_sigmas);
      table.number("latency_s", {"s", not_negative}, camera.latency_s);
      table.number("latency_jitter_s", {"s", not_negative}, camera.latency_jitter_s);
      table.number("delay_s", {"s", not_negative}, truth[TwinParameter::camera_delay].value);
      table.number("scale", {"", any_factor}, scale);
      table.number("rotation_rad", {"rad", any_number}, truth[TwinParameter::camera_rotation].value);
      table.number("missing", {"", part_of_all}, camera.missing_share);
      table.number("outliers", {"", part_of_all}, camera.outlier_share);
      table.number("outlier_size", {"body lengths", positive}, outlier);
      read_spans(table, "dark", camera.dark);
      read_spans(table, "stuck", camera.stuck);
      table.finish();
      if (sees_tip)
        camera.tail_shares = {1.};
      camera.position_sigma_m                  = position * length_m;
      camera.angle_sigma_rad                   = angle_rad;
      camera.outlier_m                         = outlier * length_m;
      truth[TwinParameter::camera_scale].value = std::log(scale);
    }

    /// Steered coils play what they are told, and nothing of their own.
    void read_steered(TomlTable &table, LabConfig &config)
    {
      table.flag("steered", config.is_steered);
      table.number("ticks_per_second", {"1/s", positive}, config.ticks_per_second);
      for (const char *key : {"bx_T", "by_T"})
        if (config.is_steered && table.has(key))
          table.note(key, "stands beside steered = true: a twin says what the coils play; leave it out.");
      if (!config.is_steered && table.has("ticks_per_second"))
        table.note("ticks_per_second", "is of steered coils; write steered = true, or leave it out.");
    }

    void read_coils(const TomlDocument &document, const Scene &scene, LabConfig &config)
    {
      config.bx_T         = scene.field.bx_T();
      config.by_T         = scene.field.by_T();
      config.frequency_Hz = scene.field.period_s() > 0. ? 1. / scene.field.period_s() : 1.;
      TomlTable table(document, "coils");
      table.number("bx_T", {"T", any_number}, config.bx_T);
      table.number("by_T", {"T", any_number}, config.by_T);
      table.number("frequency_Hz", {"Hz", positive}, config.frequency_Hz);
      table.number("lag_s", {"s", not_negative}, config.options.coils.lag_s);
      table.number("quantisation_T", {"T", not_negative}, config.options.coils.quantisation_T);
      read_steered(table, config);
      table.finish();
    }

    void read_events(const TomlDocument &document, LaboratoryOptions &options)
    {
      std::optional<double> time_s, stiffness, magnetization;
      TomlTable             change(document, "change");
      change.number("time_s", {"s", not_negative, change.present() ? Need::required : Need::optional}, time_s);
      change.number("stiffness_factor", {"", any_factor}, stiffness);
      change.number("magnetization_factor", {"", any_factor}, magnetization);
      change.finish();
      if (stiffness)
        options.changes.push_back({*time_s, TwinParameter::stiffness, std::log(*stiffness)});
      if (magnetization)
        options.changes.push_back({*time_s, TwinParameter::magnetization, std::log(*magnetization)});
      TomlTable ramp(document, "temperature");
      ramp.number("start_s", {"s", not_negative}, options.ramp.start_s);
      ramp.number("end_s", {"s", not_negative}, options.ramp.end_s);
      ramp.number("rate_K_s", {"K/s", any_number}, options.ramp.rate_K_s);
      ramp.number("viscosity_log_per_K", {"1/K", any_number}, options.ramp.viscosity_per_K);
      ramp.finish();
    }

    void require_swimmer(const std::filesystem::path &file, const Scene &scene)
    {
      const auto refuse = [&](const char *problem) {
        throw InputError(fmt::format("{} films a swimmer, but the scene {} {}; take another scene.", file.string(),
                                     scene.name, problem));
      };
      if (!scene.fluid || !scene.tail || !scene.tail->is_elastic() || !scene.head.is_free())
        refuse("has no free head with an elastic tail in a fluid");
      if (scene.head.magnetization_A_m == 0.)
        refuse("has a head without magnetization_A_m, which the twin follows");
      if (scene.head.magnetization_direction != std::array{1., 0., 0.})
        refuse("has a head that is not magnetised along its +x, as the twin takes it to be");
      if (!way_out_of_plane(scene).empty())
        refuse("leaves the plane of x and y, which is all that the camera sees");
    }

    /// What the full-order swimmer cannot do is refused.
    void require_still_swimmer(const TomlDocument &document, const LaboratoryOptions &options)
    {
      for (const char *table : {"change", "temperature"})
        if (document.find(table) != nullptr)
          document.refuse("", table, "is for a reduced swimmer; leave it out, or take a model's own.");
      for (const TwinParameter p : {TwinParameter::flow_x, TwinParameter::flow_y})
        if (options.truth[p].value != 0.)
          document.refuse("swimmer", p == TwinParameter::flow_x ? "flow_x_m_s" : "flow_y_m_s",
                          "is for a reduced swimmer; leave it out, or take a model's own.");
    }

    /// `model`: null where the swimmer is a scene's.
    LabConfig read_lab(const std::filesystem::path &file, const Scene &scene, const ReducedModel *model)
    {
      require_swimmer(file, scene);
      LabConfig             config;
      const TomlDocument    document(read_decoded_text(file, "the laboratory"), file.string(), {});
      TomlTable             top(document, "");
      int                   seed  = 1;
      std::string           plant = model ? "reduced" : "full-order";
      std::optional<double> steps_per_second;
      top.integer("seed", {"", not_negative}, seed);
      top.number("duration_s", {"s", positive}, config.duration_s);
      top.word("plant", Need::optional, model ? std::vector<std::string>{"reduced", "full-order"} : std::vector{plant},
               plant);
      config.swimmer = plant == "reduced" ? LabSwimmer::reduced : LabSwimmer::full_order;
      if (config.swimmer == LabSwimmer::reduced)
        config.inertia = read_inertia(top, *model);
      else
        top.word("inertia", Need::optional, {"none", "auto", "full"}, config.inertia);
      top.number("steps_per_second", {"1/s", positive}, steps_per_second);
      if (config.swimmer == LabSwimmer::reduced && top.has("steps_per_second"))
        top.note("steps_per_second", "is of a full-order swimmer; write plant = \"full-order\", or leave it out.");
      top.number("real_time", {"", not_negative}, config.real_time);
      for (const char *table : {"swimmer", "camera", "coils", "change", "temperature"})
        top.table(table);
      top.finish();
      LaboratoryOptions &options = config.options;
      options.nominal            = swimmer_parameters(scene);
      options.seed               = static_cast<unsigned int>(seed);
      read_lab_swimmer(document, options.nominal, options.truth);
      read_lab_camera(document, model ? ReducedSwimmer(*model).length_m() : scene.body_length_m(), config);
      read_coils(document, scene, config);
      read_events(document, options);
      options.largest_step_s = 0.025 / config.frequency_Hz;
      if (config.swimmer == LabSwimmer::reduced)
        options.densities = inertial_densities(
            *model, carried_inertia(*model, config.inertia, extreme_of(options.nominal, config.frequency_Hz)));
      else
        require_still_swimmer(document, options);
      constexpr double fewest_steps = 10.; // per period, as of scenes
      const double     of_scene     = scene.field.period_s() > 0. ? scene.time.steps_per_period * config.frequency_Hz
                                                                  : 1. / scene.time.time_step_s();
      if (steps_per_second && *steps_per_second < fewest_steps * config.frequency_Hz)
        document.refuse("", "steps_per_second",
                        fmt::format("is below {} steps per period of the coils at {:.4g} Hz; raise it.", fewest_steps,
                                    config.frequency_Hz));
      config.steps_per_frame = std::max(
          1,
          static_cast<int>(std::ceil(steps_per_second.value_or(of_scene) / options.camera.frames_per_second - 1e-9)));
      return config;
    }
  } // namespace

  LabConfig read_lab_config(const std::filesystem::path &file, const ReducedModel &model)
  {
    return read_lab(file, parse_scene(model.scene_text, model.scene_name + ".toml"), &model);
  }

  LabConfig read_lab_config(const std::filesystem::path &file, const Scene &scene)
  {
    return read_lab(file, scene, nullptr);
  }

  Scene scene_in_laboratory(Scene scene, const LabConfig &config)
  {
    const SwimmerParameters &nominal = config.options.nominal;
    const TwinParameters    &truth   = config.options.truth;
    const double             stiffer = std::exp(truth[TwinParameter::stiffness].value),
                 stronger            = std::exp(truth[TwinParameter::magnetization].value);
    scene.tail->young_modulus_Pa     = nominal.young_modulus_Pa * stiffer;
    scene.tail->magnetization_A_m    = nominal.tail_magnetization_A_m * stronger;
    scene.head.magnetization_A_m     = nominal.magnetization_A_m * stronger;
    scene.fluid->viscosity_Pa_s      = nominal.viscosity_Pa_s;
    scene.field                      = FieldProgram::sinusoidal(config.bx_T, config.by_T, config.frequency_Hz);
    scene.time.period_s              = 1. / config.frequency_Hz;
    scene.fluid->inertia             = config.inertia == "none"   ? Inertia::none
                                       : config.inertia == "full" ? Inertia::full
                                                                  : Inertia::automatic;
    scene.fluid->chosen              = inertia_terms(scene); // for the coils' sinusoid, whatever plays
    scene.fluid->inertia             = Inertia::chosen;
    scene.numerics.coupling          = CouplingScheme::monolithic; // inertia may be carried
    return scene;
  }
} // namespace swimtwin
