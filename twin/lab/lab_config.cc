#include <datasets/scene/scene.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/toml_table.h>
#include <twin/motion/carried_densities.h>
#include <twin/lab/lab_config.h>

#include <fmt/format.h>

#include <cmath>
#include <queue>

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

    std::string frame_line(const CapturedFrame &frame, const bool tells_sigmas)
    {
      std::string line = fmt::format(R"({{"type":"frame","time_s":{})", frame.stamp_s), points;
      for (const Sighting &s : frame.observations)
        switch (s.kind)
        {
        case head_position:
          line += fmt::format(R"(,"x_m":{},"y_m":{})", s.value.x(), s.value.y());
          if (tells_sigmas && s.sigma > 0.)
            line += fmt::format(R"(,"position_sigma_m":{})", s.sigma);
          break;
        case head_angle:
          line += fmt::format(R"(,"angle_rad":{})", s.value.x());
          if (tells_sigmas && s.sigma > 0.)
            line += fmt::format(R"(,"angle_sigma_rad":{})", s.sigma);
          break;
        default:
          points += fmt::format(R"({}{{"share":{},"x_m":{},"y_m":{}}})", points.empty() ? "" : ",", s.place,
                                s.value.x(), s.value.y());
        }
      return line + (points.empty() ? "}" : ",\"points\":[" + points + "]}");
    }

    struct Arrival
    {
      double      time_s = 0.;
      long        number = 0; ///< in the order of sending
      std::string line;
      bool        operator>(const Arrival &other) const
      {
        return std::make_pair(time_s, number) > std::make_pair(other.time_s, other.number);
      }
    };
  } // namespace

  LabConfig read_lab_config(const std::filesystem::path &file, const ReducedModel &model)
  {
    const Scene        scene = parse_scene(model.scene_text, model.scene_name + ".toml");
    LabConfig          config;
    const TomlDocument document(read_decoded_text(file, "the laboratory"), file.string(), {});
    TomlTable          top(document, "");
    int                seed = 1;
    top.integer("seed", {"", not_negative}, seed);
    top.number("duration_s", {"s", positive}, config.duration_s);
    const std::string inertia = read_inertia(top, model);
    top.number("real_time", {"", not_negative}, config.real_time);
    for (const char *table : {"swimmer", "camera", "coils", "change", "temperature"})
      top.table(table);
    top.finish();
    const double length_m  = ReducedSwimmer(model).length_m();
    config.options.nominal = swimmer_parameters(scene);
    config.options.seed    = static_cast<unsigned int>(seed);
    read_lab_swimmer(document, config.options.nominal, config.options.truth);
    read_lab_camera(document, length_m, config);
    read_coils(document, scene, config);
    read_events(document, config.options);
    config.options.largest_step_s = 0.025 / config.frequency_Hz;
    config.options.densities = carried_densities(inertia, model, scene, config.options.nominal, config.frequency_Hz);
    return config;
  }

  namespace
  {
    /// A laboratory at work: frames at their rate, ticks of its clock at theirs, lines when they arrive.
    class LabRun
    {
    public:
      LabRun(const ReducedModel &model, const LabConfig &config, const LabEnds &ends)
          : config_(config), ends_(ends), swimmer_(model, config.options.densities), axis_(model.tail),
            lab_(swimmer_, axis_, config.options)
      {
        if (config.is_steered)
          return;
        lab_.command().play_sinusoid(0., config.bx_T, config.by_T, config.frequency_Hz);
        post(0., fmt::format(R"({{"type":"drive","time_s":0,"bx_T":{},"by_T":{},"frequency_Hz":{}}})", config.bx_T,
                             config.by_T, config.frequency_Hz));
      }

      void run()
      {
        while (lab_.now_s() < config_.duration_s)
        {
          const double next_s = lab_.next_frame_s();
          if (config_.is_steered && !tick_until(next_s))
            return;
          const CapturedFrame frame = lab_.next_frame();
          ends_.truth({lab_.now_s(), pose_shape_and_parameters()});
          if (!frame.observations.empty())
            post(frame.arrives_s, frame_line(frame, config_.tells_sigmas));
          if (!deliver_until(lab_.now_s()))
            return;
        }
        deliver_until(infinity);
      }

    private:
      /// Of a swimmer with inertia without its velocities.
      Eigen::VectorXd pose_shape_and_parameters() const
      {
        const Eigen::VectorXd &all = lab_.truth();
        Eigen::VectorXd        some(swimmer_.n_velocities() + n_twin_parameters);
        some << all.head(swimmer_.n_velocities()), all.tail(n_twin_parameters);
        return some;
      }

      void post(const double arrives_s, std::string line) { on_the_way_.push({arrives_s, n_sent_++, std::move(line)}); }

      bool deliver_until(const double time_s)
      {
        for (; !on_the_way_.empty() && on_the_way_.top().time_s <= time_s; on_the_way_.pop())
          if (!ends_.send(on_the_way_.top().time_s, on_the_way_.top().line))
            return false;
        return true;
      }

      /// The ticks before the next frame. What is heard at a tick plays from then on, or from when it says.
      bool tick_until(const double time_s)
      {
        for (double tick_s = next_tick_s(); tick_s < time_s; tick_s = next_tick_s())
        {
          ++n_ticks_;
          if (!deliver_until(tick_s) || !ends_.send(tick_s, fmt::format(R"({{"type":"clock","time_s":{}}})", tick_s)))
            return false;
          for (const PlayMessage &play : ends_.hear(tick_s))
            lab_.command().replace(play_from(tick_s, play));
        }
        return true;
      }
      double next_tick_s() const { return static_cast<double>(n_ticks_) / config_.ticks_per_second; }

      /// The past cannot be played any more.
      static std::vector<FieldSample> play_from(const double time_s, const PlayMessage &play)
      {
        if (play.samples.front().time_s >= time_s)
          return play.samples;
        FieldSignal said;
        said.replace(play.samples);
        std::vector<FieldSample> samples = {{time_s, said.value_T(time_s), 0.}};
        for (const FieldSample &sample : play.samples)
          if (sample.time_s > time_s)
            samples.push_back(sample);
        return samples;
      }

      const LabConfig                                                   &config_;
      const LabEnds                                                     &ends_;
      ReducedSwimmer                                                     swimmer_;
      TailAxis                                                           axis_;
      Laboratory                                                         lab_;
      std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> on_the_way_;
      long                                                               n_sent_ = 0, n_ticks_ = 0;
    };
  } // namespace

  void run_laboratory(const ReducedModel &model, const LabConfig &config, const LabEnds &ends)
  {
    LabRun(model, config, ends).run();
  }
} // namespace swimtwin
