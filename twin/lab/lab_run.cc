#include <twin/lab/lab_run.h>

#include <fmt/format.h>

#include <limits>
#include <queue>

namespace swimtwin
{
  namespace
  {
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

    /// A laboratory at work: frames at their rate, ticks of its clock at theirs, lines when they arrive.
    class LabRun
    {
    public:
      LabRun(Laboratory &lab, const LabConfig &config, const LabEnds &ends) : config_(config), ends_(ends), lab_(lab)
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
          ends_.truth({lab_.now_s(), lab_.swimmer().truth()});
          if (!frame.observations.empty())
            post(frame.arrives_s, frame_line(frame, config_.tells_sigmas));
          if (!deliver_until(lab_.now_s()))
            return;
        }
        deliver_until(std::numeric_limits<double>::infinity());
      }

    private:
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
      Laboratory                                                        &lab_;
      std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> on_the_way_;
      long                                                               n_sent_ = 0, n_ticks_ = 0;
    };
  } // namespace

  void run_laboratory(Laboratory &lab, const LabConfig &config, const LabEnds &ends)
  {
    LabRun(lab, config, ends).run();
  }

  void run_laboratory(const ReducedModel &model, const LabConfig &config, const LabEnds &ends)
  {
    const ReducedSwimmer swimmer(model, config.options.densities);
    const TailAxis       axis(model.tail);
    ReducedLaboratory    imagined(swimmer, axis, config.options);
    run_laboratory(imagined.lab, config, ends);
  }
} // namespace swimtwin
