#include <control/goal/goal_entries.h>
#include <control/steering/steered_field.h>
#include <datasets/observation/calibration_result.h>
#include <datasets/scene/scene.h>
#include <datasets/system/error.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/toml_table.h>
#include <rom/swimmer/carried_inertia.h>
#include <twin/estimate/model_bias.h>
#include <twin/motion/inertia_entry.h>
#include <twin/stream/twin_config.h>

#include <fmt/format.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr Range tail_share{0., 1., false, false, "be a share of the tail's axis, 0 (root) to 1 (tip)"};
    constexpr Range log_value{-2., 2., false, false, "be the logarithm of a ratio, -2 to 2"};
    constexpr Range likely_delay{0., 2., false, false, "be 0 to 2 s"};
    constexpr Range share_of_one{0., 0.1, true, false, "be above 0 and at most 0.1"};

    /// A parameter without an entry is fixed where it is; those of the swimmer are estimated unless sd = 0.
    void read_parameters(const TomlDocument &document, TwinParameters &parameters)
    {
      TomlTable all(document, "parameters");
      for (const char *name : twin_parameter_names)
        all.table(name);
      all.number("viscosity_log_drift_per_root_s", {"1/sqrt(s)", not_negative}, parameters.viscosity_drift);
      all.finish();
      for (int i = 0; i < n_twin_parameters; ++i)
      {
        DriftingParameter &parameter = parameters.list[static_cast<std::size_t>(i)];
        const std::string  name      = twin_parameter_names[static_cast<std::size_t>(i)];
        const bool         is_log = name.ends_with("_log"), is_delay = name.starts_with("camera_delay");
        TomlTable          table(document, "parameters." + name);
        if (!table.present())
          continue;
        table.number("value", {"", is_log ? log_value : is_delay ? likely_delay : any_number}, parameter.value);
        table.number("sd", {"", not_negative}, parameter.standard_deviation);
        table.number("drift_per_root_s", {"", not_negative}, parameter.drift);
        table.finish();
      }
    }

    void read_field(const TomlDocument &document, const std::filesystem::path &folder, const Scene &scene,
                    TwinConfig &config)
    {
      TomlTable             table(document, "field");
      std::optional<double> bx, by, frequency;
      std::string           file;
      table.number("bx_T", {"T", any_number}, bx);
      table.number("by_T", {"T", any_number}, by);
      table.number("frequency_Hz", {"Hz", positive}, frequency);
      table.number("start_s", {"s", any_number}, config.drive_start_s);
      table.text("file", file);
      table.finish();
      if (!file.empty() && (bx || by))
        document.refuse("field", "file", "stands beside bx_T or by_T; give a file, or a sinusoid.");
      if (!file.empty())
      {
        config.field_file = folder / file;
        config.drive      = make_drive(FieldProgram::read_csv(config.field_file, frequency ? 1. / *frequency : 0.));
      }
      else if (bx || by || frequency)
      {
        if (!bx || !by || !frequency)
          document.refuse("field",
                          !bx   ? "bx_T"
                          : !by ? "by_T"
                                : "frequency_Hz",
                          "is missing; a sinusoid is bx_T, by_T and frequency_Hz.");
        config.drive = make_drive(FieldProgram::sinusoidal(*bx, *by, *frequency));
      }
      if (config.drive)
        config.period_s = 1. / config.drive->frequency_Hz;
      else if (scene.field.period_s() > 0.)
        config.period_s = scene.field.period_s();
    }

    void read_points(const TomlDocument &document, CameraConfig &camera)
    {
      const toml::node *points = document.find("camera.points");
      if (points == nullptr)
        return;
      TomlTable table(document, "camera.points");
      if (const auto *names = points->as_table())
        for (const auto &[key, value] : *names)
          table.number(std::string(key.str()), {"", tail_share}, camera.points[std::string(key.str())]);
      table.finish();
    }

    void read_camera(const TomlDocument &document, CameraConfig &camera)
    {
      TomlTable table(document, "camera");
      table.number("position_sigma_m", {"m", positive}, camera.position_sigma_m);
      table.number("angle_sigma_rad", {"rad", positive}, camera.angle_sigma_rad);
      table.flag("y_down", camera.y_down);
      table.table("points");
      table.finish();
      read_points(document, camera);
    }

    void read_start(const TomlDocument &document, TwinOptions &options)
    {
      TomlTable table(document, "start");
      table.number("angle_rad", {"rad", any_number}, options.start.angle_rad);
      table.number("angle_sd_rad", {"rad", positive}, options.start.angle_sd_rad);
      table.finish();
    }

    /// What plays, as far as the configuration says; else the scene's field.
    std::optional<Drive> nominal_drive(const TwinConfig &config, const Scene &scene)
    {
      if (config.steering)
        return config.steering->goal.carrier;
      if (!config.drive && scene.field.period_s() > 0.)
        return make_drive(scene.field);
      return config.drive;
    }

    void read_model_error(const TomlDocument &document, const ReducedModel &model, const std::optional<Drive> &drive,
                          TwinOptions &options)
    {
      const ReducedSwimmer swimmer(model);
      const double         length_m = swimmer.length_m();
      ModelNoise          &noise    = options.noise;
      double    position = noise.position_m / length_m, shape = 1., displacement = held_out_displacement_error(model);
      TomlTable table(document, "model_error");
      table.number("position_per_root_s", {"body lengths/sqrt(s)", positive}, position);
      table.number("angle_rad_per_root_s", {"rad/sqrt(s)", positive}, noise.angle_rad);
      table.number("shape_factor", {"", positive}, shape);
      table.number("displacement", {"", not_negative}, displacement);
      table.finish();
      noise.position_m = position * length_m;
      noise.shape_m *= shape;
      const auto sd = [&](const TwinParameter p) { return options.parameters[p].standard_deviation; };
      if (!drive)
        return;
      try
      {
        options.ratio_bias = ratio_bias(swimmer, options.nominal, *drive, displacement,
                                        {sd(TwinParameter::stiffness), sd(TwinParameter::magnetization)});
      }
      catch (const ComputationError &) // no periodic motion: nothing repeats
      {
      }
    }

    void read_filter(const TomlDocument &document, TwinConfig &config)
    {
      FilterOptions &filter = config.options.filter;
      TomlTable      table(document, "filter");
      table.number("window_s", {"s", positive}, filter.window_s);
      table.number("knee", {"standard deviations", positive}, filter.robustness.knee);
      table.number("gate", {"standard deviations", positive}, filter.robustness.gate);
      table.number("largest_step_s", {"s", positive}, config.options.largest_step_s);
      table.number("largest_gap_s", {"s", positive}, config.largest_gap_s);
      if (filter.robustness.gate < filter.robustness.knee)
        table.note("gate", fmt::format("is below knee = {}; an outlier must be farther off than what counts less.",
                                       filter.robustness.knee));
      table.finish();
    }

    void read_watch(const TomlDocument &document, TwinConfig &config)
    {
      WatchOptions &watch = config.watch;
      TomlTable     table(document, "watch");
      table.number("sight_lost_s", {"s", positive}, watch.sight_lost_s);
      table.integer("frozen_frames", {"", {2., infinity, false, false, "be at least 2"}}, watch.frozen_frames);
      table.number("consistency", {"", share_of_one}, watch.consistency);
      table.number("wall_clearance", {"body lengths", not_negative}, watch.wall_clearance);
      table.number("jump_threshold", {"", positive}, config.options.jumps.threshold);
      table.finish();
    }

    void read_output(const TomlDocument &document, TwinConfig &config)
    {
      constexpr Range few_periods{0., 50., false, false, "be 0 to 50 periods"};
      TomlTable       table(document, "output");
      table.number("forecast_periods", {"", few_periods}, config.output.forecast_periods);
      table.number("forecast_every_s", {"s", positive}, config.output.forecast_every_s);
      table.number("smoothing_lag_s", {"s", not_negative}, config.output.smoothing_lag_s);
      table.integer("save_every", {"lines", at_least_one}, config.save_every);
      if (config.output.smoothing_lag_s > config.options.filter.window_s)
        table.note("smoothing_lag_s", fmt::format("is longer than [filter] window_s = {:.4g}; raise that, or look back "
                                                  "less far.",
                                                  config.options.filter.window_s));
      table.finish();
    }

    /// [telling]: the present carrier's size and frequencies about its own, or the coils' limits of a goal.
    void read_telling(const TomlDocument &document, TwinConfig &config)
    {
      if (document.find("telling") == nullptr)
        return;
      const Drive *drive = config.steering ? &config.steering->goal.carrier : config.drive ? &*config.drive : nullptr;
      if (drive == nullptr)
        document.refuse("telling", "parameter", "needs a field that plays, to be changed; add [field], or a [goal].");
      TellingOptions telling;
      telling.largest_T   = largest_T(*drive);
      telling.lowest_Hz   = 0.5 * drive->frequency_Hz;
      telling.highest_Hz  = 2. * drive->frequency_Hz;
      telling.keeps_speed = config.steering.has_value();
      if (config.steering)
      {
        telling.coils = config.steering->goal.limits;
        if (telling.coils.magnitude_T < FieldLimits::none)
          telling.largest_T = telling.coils.magnitude_T;
      }
      std::vector<std::string> names;
      for (int i = 0; i < n_twin_parameters; ++i)
        if (config.options.parameters.list[static_cast<std::size_t>(i)].is_estimated())
          names.emplace_back(twin_parameter_names[static_cast<std::size_t>(i)]);
      std::string name;
      TomlTable   table(document, "telling");
      table.word("parameter", Need::required, names, name);
      table.number("ahead_periods", {"", {0.5, 20., false, false, "be 0.5 to 20 periods"}}, telling.ahead_periods);
      table.number("every_periods", {"", at_least_one}, telling.every_periods);
      table.number("largest_T", {"T", positive}, telling.largest_T);
      table.number("lowest_Hz", {"Hz", positive}, telling.lowest_Hz);
      table.number("highest_Hz", {"Hz", positive}, telling.highest_Hz);
      table.flag("keeps_speed", telling.keeps_speed);
      if (telling.lowest_Hz > telling.highest_Hz)
        table.note("lowest_Hz", fmt::format("is above highest_Hz = {:.4g}; exchange them.", telling.highest_Hz));
      table.finish();
      for (int i = 0; i < n_twin_parameters; ++i)
        if (name == twin_parameter_names[static_cast<std::size_t>(i)])
          telling.parameter = static_cast<TwinParameter>(i);
      config.telling = telling;
    }

    /// Values and standard errors of a calibration's two ratios.
    void take_prior(const std::filesystem::path &file, TwinOptions &options)
    {
      const CalibrationResult result    = read_calibration_result(file);
      options.nominal.young_modulus_Pa  = result.swimmer.young_modulus_Pa;
      options.nominal.viscosity_Pa_s    = result.swimmer.viscosity_Pa_s;
      options.nominal.magnetization_A_m = result.swimmer.magnetization_A_m * result.swimmer.field_scale;
      const auto take                   = [&](const char *name, const TwinParameter p) {
        const CalibratedParameter *found = result.find(name);
        if (found != nullptr && found->standard_error && found->value > 0.)
          options.parameters[p].standard_deviation = *found->standard_error / found->value;
      };
      take("young_modulus_over_viscosity_1_s", TwinParameter::stiffness);
      take("magnetization_over_viscosity_A_m_Pa_s", TwinParameter::magnetization);
    }
  } // namespace

  std::vector<std::filesystem::path> TwinConfig::files() const
  {
    std::vector<std::filesystem::path> all;
    for (const auto &file : {prior, field_file, steering ? steering->file : std::filesystem::path()})
      if (!file.empty())
        all.push_back(file);
    return all;
  }

  TwinConfig read_twin_config(const std::filesystem::path &file, const ReducedModel &model)
  {
    const Scene scene = parse_scene(model.scene_text, model.scene_name + ".toml");
    TwinConfig  config;
    config.text = read_decoded_text(file, "the twin's configuration");
    const TomlDocument document(config.text, file.string(), {});
    TomlTable          top(document, "");
    std::string        prior;
    top.text("prior", prior);
    const std::string inertia = read_inertia(top, model);
    config.states_inertia     = top.has("inertia");
    for (const char *table : {"swimmer", "parameters", "field", "camera", "start", "model_error", "filter", "watch",
                              "output", "goal", "telling"})
      top.table(table);
    top.finish();
    read_field(document, file.parent_path(), scene, config);
    if (document.find("goal") != nullptr)
    {
      config.steering = read_steering(document, file.parent_path(), model);
      if (config.drive)
        document.refuse("field", config.field_file.empty() ? "bx_T" : "file",
                        "stands beside [goal], whose carrier is what plays; leave [field] out.");
      config.period_s = 1. / config.steering->goal.carrier.frequency_Hz;
    }
    config.options = default_twin_options(model, swimmer_parameters(scene), 1. / config.period_s);
    config.options.parameters[TwinParameter::stiffness]     = {0., 0.1, 1e-3};
    config.options.parameters[TwinParameter::magnetization] = {0., 0.1, 1e-3};
    config.output.forecast_every_s                          = config.period_s;
    config.watch.sight_lost_s                               = 0.5 * config.period_s;
    if (!prior.empty())
    {
      config.prior = file.parent_path() / prior;
      take_prior(config.prior, config.options);
    }
    read_swimmer(document, "swimmer", config.options.nominal);
    config.options.densities = inertial_densities(
        model, carried_inertia(model, inertia, extreme_of(config.options.nominal, 1. / config.period_s)));
    read_parameters(document, config.options.parameters);
    read_camera(document, config.camera);
    read_start(document, config.options);
    read_model_error(document, model, nominal_drive(config, scene), config.options);
    read_filter(document, config);
    read_watch(document, config);
    config.options.search_pose_after_s = config.watch.sight_lost_s;
    read_output(document, config);
    read_telling(document, config);
    if (config.steering && config.options.filter.window_s < config.period_s)
      document.refuse(
          "filter", "window_s",
          fmt::format("is shorter than a period of the goal's carrier ({:.4g} s), over which the swimmer is "
                      "led; raise it.",
                      config.period_s));
    return config;
  }
} // namespace swimtwin
