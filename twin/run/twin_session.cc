#include <datasets/system/error.h>
#include <twin/filter/smoother.h>
#include <twin/run/session_memory.h>
#include <twin/run/twin_session.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr int    frames_of_a_new_clock = 30;  ///< refused one after the other: the clock began anew
    constexpr double open_every_periods    = 10.; ///< what keeps its prior is said so often
    constexpr int    forecast_instants     = 8;   ///< per period
  }                                               // namespace

  TwinSession::TwinSession(const ReducedModel &model, const TwinConfig &config, Listeners listeners)
      : model_(model), config_(config), listeners_(std::move(listeners)), twin_(model, config.options),
        watchdog_(twin_, model, config.watch, config.period_s)
  {
    if (config.drive)
      twin_.field().play(config.drive_start_s, *config.drive);
    if (config.steering)
      pilot_.emplace(twin_, model, *config.steering);
    if (config.telling)
      telling_.emplace(model, config.options, *config.telling);
  }

  void TwinSession::greet()
  {
    has_clock_ = false; // another client may have none
    listeners_.say(greeting_line(twin_, model_.scene_name));
    if (pilot_ && pilot_->has_path())
      listeners_.say(path_line(clock_s_, pilot_->path()));
  }

  void TwinSession::refuse(const std::string &sentence)
  {
    ++counts_.n_errors;
    listeners_.say(error_line(counts_.n_lines, sentence));
  }

  void TwinSession::refuse_line(const std::string &sentence)
  {
    ++counts_.n_lines;
    refuse(sentence);
  }

  void TwinSession::take(const std::string_view line, const std::string_view where)
  {
    ++counts_.n_lines;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos)
      return;
    try
    {
      Message message = parse_message(line, config_.camera);
      if (auto *frame = std::get_if<Frame>(&message))
        see(std::move(*frame));
      else if (const auto *sample = std::get_if<FieldSample>(&message))
        hear(*sample);
      else if (const auto *drive = std::get_if<DriveMessage>(&message))
        hear(*drive);
      else if (const auto *play = std::get_if<PlayMessage>(&message))
        hear(*play);
      else if (const auto *clock = std::get_if<ClockMessage>(&message))
        hear(*clock);
      else if (std::holds_alternative<RestartMessage>(message))
        restart();
      else
        has_ended_ = true;
    }
    catch (const InputError &error)
    {
      refuse(where.empty() ? error.what() : fmt::format("{}: {}", where, error.what()));
    }
    clock_at_last_line_s_ = clock_s_;
  }

  void TwinSession::restart()
  {
    twin_.forget_pose();
    n_refused_in_a_row_ = 0;
    clock_s_            = -1e300;
    if (pilot_)
      pilot_->forget_time();
    next_forecast_s_ = next_open_s_ = next_proposal_s_ = -1e300;
    has_clock_                                         = false;
    if (telling_)
      telling_->give_up();
  }

  /// A clock that leaps is an error of one frame, until so many agree that it is the clock.
  void TwinSession::require_plausible_time(const Frame &frame)
  {
    const double ahead_s = frame.time_s - (twin_.now_s() + twin_.camera().reference_delay_s);
    if (ahead_s <= config_.largest_gap_s)
      return;
    if (++n_refused_in_a_row_ < frames_of_a_new_clock)
      throw InputError(
          fmt::format("time_s = {:.6g} is {:.4g} s after the last frame, more than [filter] largest_gap_s = "
                      "{:.4g}; check the clock, or send {{\"type\": \"restart\"}} first.",
                      frame.time_s, ahead_s, config_.largest_gap_s));
  }

  void TwinSession::see(Frame frame)
  {
    ++counts_.n_frames;
    if (twin_.has_started())
      require_plausible_time(frame);
    const bool is_older = twin_.is_too_old(frame.time_s, frame.observations);
    if (is_older)
      ++n_refused_in_a_row_;
    if (n_refused_in_a_row_ >= frames_of_a_new_clock)
    {
      tell({{"clock-jumped", frame.time_s, fmt::format("{} frames in a row are of another time", n_refused_in_a_row_),
             "nothing: the pose is found anew; keep the camera's and the coils' clocks the same"}},
           frame.time_s);
      restart();
    }
    else if (is_older)
    {
      ++counts_.n_late;
      throw InputError(
          fmt::format("time_s = {:.6g} is before the window, which begins at {:.6g}; send frames sooner, or "
                      "raise [filter] window_s = {:.4g}.",
                      frame.time_s, twin_.filter().node(0).time_s + twin_.camera().reference_delay_s,
                      config_.options.filter.window_s));
    }
    switch (twin_.see(frame.time_s, frame.observations))
    {
    case Insertion::too_old:
      throw InputError(
          "the frame cannot begin the estimate, because it does not show the head; send x_m and y_m first.");
    case Insertion::failed:
      twin_.forget_pose();
      throw InputError(fmt::format("the model finds no motion that leads to time_s = {:.6g} and begins anew; check the "
                                   "field and the values of the frame.",
                                   frame.time_s));
    case Insertion::replayed:
      ++counts_.n_late;
      break;
    case Insertion::in_order:
      break;
    }
    n_refused_in_a_row_ = 0;
    answer_frame(frame);
    if (pilot_ && !has_clock_)
      come_to(frame.time_s + config_.steering->latency_s);
  }

  void TwinSession::answer_frame(const Frame &frame)
  {
    if (!twin_.belief().mean.allFinite() || !twin_.belief().root.allFinite())
    {
      twin_.forget_pose();
      throw InputError("the frame leaves no finite estimate, which begins anew; check its values.");
    }
    const Eigen::Vector2d field_T = twin_.process().field_T(twin_.now_s(), twin_.belief().mean);
    tell(watchdog_.look(frame, field_T), twin_.now_s());
    const FilterNode &node = twin_.filter().latest();
    EstimateRecord    r{node.time_s,
                     counts_.n_lines,
                     false,
                     node.filtered,
                     node.innovations,
                     watchdog_.significance(),
                     watchdog_.trust(node.time_s),
                     watchdog_.flags()};
    if (twin_.is_searching_delay())
      r.flags.emplace_back(watch_flag::searching_delay);
    listeners_.say(estimate_line(twin_, r));
    listeners_.note(r);
    tell_now_and_then();
  }

  void TwinSession::tell(const std::vector<Alarm> &alarms, const double time_s)
  {
    for (const Alarm &alarm : alarms)
    {
      counts_.n_alarms += !alarm.is_over;
      listeners_.say(alarm_line(alarm, time_s));
    }
  }

  void TwinSession::tell_now_and_then()
  {
    const double now_s = twin_.now_s();
    if (now_s >= next_forecast_s_ && !twin_.is_searching_delay())
    {
      if (config_.output.forecast_periods > 0.)
        forecast();
      if (config_.output.smoothing_lag_s > 0.)
        smooth();
      next_forecast_s_ = now_s + config_.output.forecast_every_s;
    }
    if (now_s >= next_open_s_)
    {
      if (next_open_s_ > -1e299)
        listeners_.say(open_line(now_s, twin_.unlearned()));
      next_open_s_ = now_s + open_every_periods * config_.period_s;
    }
    if (telling_ && !twin_.is_searching_delay())
      propose_field();
  }

  /// One trial with each frame, so that none is late for it.
  void TwinSession::propose_field()
  {
    const double now_s = twin_.now_s();
    if (next_proposal_s_ < -1e299) // not before there is something to tell
      next_proposal_s_ = now_s + std::min(telling_->options().every_periods, 5.) * config_.period_s;
    if (telling_->is_searching())
    {
      if (const auto proposal = telling_->go_on())
        listeners_.say(proposal_line(twin_, *proposal));
      return;
    }
    if (now_s < next_proposal_s_)
      return;
    constexpr int enough_instants = 10; // of the window, to know how often something is seen
    if (twin_.filter().n_nodes() < enough_instants || (pilot_ && !pilot_->plays_carrier()))
      return;
    next_proposal_s_ = now_s + telling_->options().every_periods * config_.period_s;
    if (pilot_)
      telling_->begin(twin_, turned(config_.steering->goal.carrier, pilot_->carrier_angle_rad(now_s)),
                      pilot_->carrier_start_s());
    else if (const FieldSignal::Program *program = twin_.field().program_at(now_s))
      telling_->begin(twin_, program->drive, program->start_s);
  }

  void TwinSession::forecast()
  {
    ForecastRecord r{twin_.now_s(), {}};
    Belief         belief = twin_.belief();
    const int      n = std::max(1, static_cast<int>(std::lround(config_.output.forecast_periods * forecast_instants)));
    const double   step_s = config_.output.forecast_periods * config_.period_s / n;
    for (int i = 0; i < n; ++i)
    {
      if (!twin_.filter().predict(r.from_s + i * step_s, r.from_s + (i + 1) * step_s, belief))
        break;
      r.instants.emplace_back(r.from_s + (i + 1) * step_s, belief);
    }
    listeners_.say(forecast_line(twin_, r));
  }

  void TwinSession::smooth()
  {
    const WindowFilter &filter   = twin_.filter();
    const double        wanted_s = twin_.now_s() - config_.output.smoothing_lag_s;
    int                 i        = 0;
    while (i + 1 < filter.n_nodes() && filter.node(i).time_s < wanted_s)
      ++i;
    if (filter.n_nodes() > 1)
      listeners_.say(smoothed_line(twin_, filter.node(i).time_s, smoothed_beliefs(filter, i).front()));
  }

  void TwinSession::hear(const FieldSample &sample)
  {
    twin_.field().add(sample);
    twin_.field_changed_from(sample.time_s);
    forget_old_field();
    if (twin_.has_started())
      tell(watchdog_.wait(std::min(sample.time_s, twin_.now_s() + config_.largest_gap_s)), sample.time_s);
  }

  void TwinSession::hear(const DriveMessage &drive)
  {
    twin_.field().play_sinusoid(drive.time_s, drive.bx_T, drive.by_T, drive.frequency_Hz);
    twin_.field_changed_from(drive.time_s);
    forget_old_field();
  }

  /// What a frame may still be about stays.
  void TwinSession::forget_old_field()
  {
    if (twin_.has_started())
      twin_.field().forget_before(twin_.filter().node(0).time_s - config_.period_s);
  }

  void TwinSession::hear(const PlayMessage &play)
  {
    twin_.field().replace(play.samples);
    twin_.field_changed_from(play.time_s);
  }

  void TwinSession::hear(const ClockMessage &clock)
  {
    if (has_clock_ && clock.time_s < clock_s_)
      throw InputError(
          fmt::format("time_s = {:.6g} of the clock is before {:.6g}, which came already; let it go on, or "
                      "send {{\"type\": \"restart\"}} first.",
                      clock.time_s, clock_s_));
    has_clock_ = true;
    come_to(clock.time_s);
    listeners_.say(clock_line(clock.time_s));
  }

  /// It is at least this time: a control period may be over.
  void TwinSession::come_to(const double time_s)
  {
    clock_s_ = std::max(clock_s_, time_s);
    tell(watchdog_.wait(clock_s_ - twin_.camera().reference_delay_s), clock_s_);
    if (!pilot_ || is_repeating_ || !pilot_->is_due(clock_s_))
      return;
    const std::vector<std::string> flags = watchdog_.flags();
    const bool                     has_sight =
        twin_.has_started() && std::find(flags.begin(), flags.end(), watch_flag::sight_lost) == flags.end();
    const bool       had_path = pilot_->has_path();
    const PlayRecord record   = pilot_->decide(clock_s_, has_sight);
    forget_old_field();
    if (pilot_->has_path() && !had_path)
      listeners_.say(path_line(record.decided_s, pilot_->path()));
    listeners_.say(play_line(record));
    listeners_.steered(record);
  }

  void TwinSession::wait(const double since_last_line_s)
  {
    if (!twin_.has_started() || has_clock_) // its clock says what time it is
      return;
    if (pilot_)
      come_to(clock_at_last_line_s_ + since_last_line_s);
    else
      tell(watchdog_.wait(twin_.now_s() + since_last_line_s), twin_.now_s() + since_last_line_s);
  }

  void TwinSession::take_again(const std::string_view line)
  {
    const bool was_said = line.starts_with(play_line_start);
    is_repeating_       = true;
    take(line);
    is_repeating_ = false;
    counts_.n_lines -= was_said;
  }

  void TwinSession::finish()
  {
    if (twin_.has_started())
      listeners_.say(open_line(twin_.now_s(), twin_.unlearned()));
    listeners_.say(end_line(counts_));
  }

  nlohmann::ordered_json TwinSession::memory() const
  {
    if (!twin_.has_started())
      return nullptr;
    RememberedSession session;
    session.counts          = counts_;
    session.next_forecast_s = next_forecast_s_;
    session.next_open_s     = next_open_s_;
    if (telling_) // a search that is under way begins anew
      session.next_proposal_s = telling_->is_searching() ? twin_.now_s() : next_proposal_s_;
    if (pilot_)
      session.pilot = pilot_->memory();
    remember(twin_.field(), session);
    remember(twin_.memory(), session);
    return json_of(session);
  }

  void TwinSession::restore(const nlohmann::ordered_json &memory)
  {
    RememberedSession session;
    read_json(memory, session);
    const Eigen::Index n = twin_.layout().n_states();
    if (session.at_window_start.size() != n || session.at_window_start.root.rows() != n ||
        session.at_window_start.root.cols() != n)
      throw InputError(fmt::format("has a state of {} numbers where this model and configuration have {}",
                                   session.at_window_start.size(), n));
    recall(session, config_.drive ? &*config_.drive : nullptr, twin_.field());
    twin_.restore(recall(session));
    counts_          = session.counts;
    next_forecast_s_ = session.next_forecast_s;
    next_open_s_     = session.next_open_s;
    next_proposal_s_ = session.next_proposal_s.value_or(-1e300);
    if (pilot_ && session.pilot)
      pilot_->restore(*session.pilot);
  }
} // namespace swimtwin
