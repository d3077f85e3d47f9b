#include <twin/estimate/swimmer_twin.h>
#include <twin/filter/triangular_root.h>

#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// One for each thing that may change at once, as far as it is estimated.
    std::vector<JumpHypothesis> jump_hypotheses(const TwinLayout &layout, const double length_m)
    {
      std::vector<JumpHypothesis> hypotheses;
      const Eigen::VectorXd       zero = Eigen::VectorXd::Zero(layout.n_states());
      const auto                  add  = [&](const char *name, const std::vector<std::pair<int, double>> &entries) {
        Eigen::VectorXd direction = zero;
        for (const auto &[place, size] : entries)
          direction[place] = size;
        hypotheses.push_back({name, direction});
      };
      const int stiffness = layout.place(TwinParameter::stiffness), magnet = layout.place(TwinParameter::magnetization);
      if (stiffness >= 0)
        add("stiffness", {{stiffness, 1.}});
      if (magnet >= 0)
        add("magnetization", {{magnet, 1.}});
      if (stiffness >= 0 && magnet >= 0)
        add("viscosity", {{stiffness, -1.}, {magnet, -1.}});
      if (const int rotation = layout.place(TwinParameter::camera_rotation); rotation >= 0)
        add("camera rotation", {{rotation, 1.}});
      if (const int scale = layout.place(TwinParameter::camera_scale); scale >= 0)
        add("camera scale", {{scale, 1.}});
      add("position along x (the camera or the swimmer was moved)", {{0, length_m}});
      add("position along y (the camera or the swimmer was moved)", {{1, length_m}});
      add("head's angle (the swimmer or the camera was turned)", {{2, 1.}});
      return hypotheses;
    }

    constexpr double instant_later_s = 1e-6;

    bool shows_head(const std::vector<Sighting> &observations)
    {
      return std::any_of(observations.begin(), observations.end(),
                         [](const Sighting &o) { return o.kind == head_position; });
    }
  } // namespace

  bool has_used_sighting(const std::vector<Innovation> &innovations)
  {
    const auto any = [&](const bool wants_angle) {
      return std::any_of(innovations.begin(), innovations.end(),
                         [&](const Innovation &i) { return i.weight > 0. && (i.kind == head_angle) == wants_angle; });
    };
    const bool shows_positions =
        std::any_of(innovations.begin(), innovations.end(), [](const Innovation &i) { return i.kind != head_angle; });
    return any(!shows_positions);
  }

  SwimmerTwin::SwimmerTwin(const ReducedModel &model, const TwinOptions &options)
      : options_(options), model_(model, options), filter_(model_.process, model_.camera, options.filter),
        hypotheses_(jump_hypotheses(model_.layout, model_.swimmer.length_m()))
  {
    model_.camera.reference_delay_s = options.parameters[TwinParameter::camera_delay].value;
  }

  Belief SwimmerTwin::first_belief(const double instant_s, const std::vector<Sighting> &observations) const
  {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(model_.layout.n_states()), sd = mean;
    for (int i = 0; i < n_twin_parameters; ++i)
      if (const auto p = static_cast<TwinParameter>(i); model_.layout.is_estimated(p))
      {
        mean[model_.layout.place(p)] = options_.parameters[p].value;
        sd[model_.layout.place(p)]   = options_.parameters[p].standard_deviation;
      }
    const StartBelief    &start = options_.start;
    const Eigen::Vector2d field = model_.field.value_T(instant_s);
    mean[2]                     = start.angle_rad.value_or(field.norm() > 0. ? std::atan2(field.y(), field.x()) : 0.);
    sd[2]                       = start.angle_sd_rad;
    for (const Sighting &o : observations)
    {
      if (o.kind == head_position)
        mean.head<2>() = model_.camera.in_laboratory(o.value, mean);
      if (o.kind == head_angle && !start.angle_rad)
        mean[2] = o.value[0] - model_.layout.value(TwinParameter::camera_rotation, mean);
    }
    sd.head<2>().setConstant(model_.swimmer.length_m());
    sd.segment(3, model_.swimmer.n_modes()) = start.shape_sd_m;
    if (const int n = model_.swimmer.n_velocities(); model_.swimmer.has_inertia())
      sd.segment(n, n) = sd.head(n) / start.period_s;
    Belief belief = Belief::independent(mean, sd);
    if (kept_parameters_)
    {
      const Eigen::Index k                = kept_parameters_->size();
      belief.mean.tail(k)                 = kept_parameters_->mean;
      belief.root.bottomRightCorner(k, k) = kept_parameters_->root;
    }
    return belief;
  }

  void SwimmerTwin::start(const double instant_s, const std::vector<Sighting> &observations)
  {
    filter_.gated_from_s = instant_s + options_.search_pose_after_s;
    filter_.start(instant_s, first_belief(instant_s, observations),
                  JumpTest(hypotheses_, options_.jumps.interval_s, options_.jumps.n_instants));
    // The first frame is an observation like all others, an instant after the belief that it began.
    filter_.add({instant_s + instant_later_s, observations});
    started_s_ = last_used_s_ = instant_s;
    quiet_until_s_            = instant_s + options_.jumps.settle_s;
  }

  /// Taken before the frame that began the estimate, which nothing has left since.
  bool SwimmerTwin::was_overtaken(const double instant_s, const std::vector<Sighting> &observations) const
  {
    return filter_.node(0).time_s == started_s_ && instant_s <= started_s_ &&
           instant_s > started_s_ - options_.filter.window_s && shows_head(observations);
  }

  bool SwimmerTwin::is_too_old(const double stamp_s, const std::vector<Sighting> &observations) const
  {
    const double instant_s = model_.camera.instant_s(stamp_s);
    return has_started() && instant_s <= filter_.node(0).time_s && !was_overtaken(instant_s, observations);
  }

  /// As if the frames had come in their order.
  void SwimmerTwin::start_earlier(const double instant_s, const std::vector<Sighting> &observations)
  {
    std::vector<Frame> later = memory().frames;
    if (!later.empty() && instant_s < started_s_)
      later.front().time_s = started_s_; // the one that began the estimate
    start(instant_s, observations);
    for (const Frame &frame : later)
      filter_.add(frame);
  }

  Insertion SwimmerTwin::see(const double stamp_s, const std::vector<Sighting> &observations)
  {
    alarm_.reset();
    if (!has_started())
    {
      if (!shows_head(observations))
        return Insertion::too_old;
      is_searching_ = model_.layout.is_estimated(TwinParameter::camera_delay) && !kept_parameters_;
      if (is_searching_)
        start_frames_.push_back({stamp_s, observations});
      start(model_.camera.instant_s(stamp_s), observations);
      return Insertion::in_order;
    }
    if (is_searching_)
      start_frames_.push_back({stamp_s, observations});
    if (revisit_from_s_ < now_s())
      filter_.revisit(revisit_from_s_);
    revisit_from_s_        = std::numeric_limits<double>::infinity();
    const double instant_s = model_.camera.instant_s(stamp_s);
    Insertion    insertion = Insertion::replayed;
    if (was_overtaken(instant_s, observations))
      start_earlier(instant_s, observations);
    else
      insertion = filter_.add({instant_s, observations});
    if (is_searching_ && now_s() - started_s_ >= options_.delay_search_s)
      search_delay();
    else if (!is_searching_)
      keep_delay_reference();
    watch_for_jumps();
    watch_for_loss();
    return insertion;
  }

  double SwimmerTwin::run_through_start(const double delay_s)
  {
    model_.camera.reference_delay_s = delay_s;
    start(model_.camera.instant_s(start_frames_.front().time_s), start_frames_.front().observations);
    double log_likelihood = 0.;
    for (std::size_t i = 1; i < start_frames_.size(); ++i)
    {
      filter_.add({model_.camera.instant_s(start_frames_[i].time_s), start_frames_[i].observations});
      log_likelihood += filter_.latest().log_likelihood;
    }
    return log_likelihood;
  }

  /// All that was seen so far with one delay after the other; the likeliest is refined.
  void SwimmerTwin::search_delay()
  {
    const DriftingParameter &prior = options_.parameters[TwinParameter::camera_delay];
    std::stable_sort(start_frames_.begin(), start_frames_.end(),
                     [](const Frame &a, const Frame &b) { return a.time_s < b.time_s; });
    const double low  = std::max(0., prior.value - 2. * prior.standard_deviation),
                 high = prior.value + 2. * prior.standard_deviation;
    const int n       = std::max(1, static_cast<int>(std::ceil((high - low) / options_.delay_search_step_s)));
    double    best = low, best_likelihood = -std::numeric_limits<double>::infinity();
    for (int i = 0; i <= n; ++i)
    {
      const double delay_s = low + (high - low) * i / n, likelihood = run_through_start(delay_s);
      if (likelihood > best_likelihood)
      {
        best            = delay_s;
        best_likelihood = likelihood;
      }
    }
    run_through_start(best);
    for (int i = 0; i < 3; ++i)
      run_through_start(belief().mean[model_.layout.place(TwinParameter::camera_delay)]);
    is_searching_ = false;
    start_frames_.clear();
  }

  void SwimmerTwin::keep_delay_reference()
  {
    if (!model_.layout.is_estimated(TwinParameter::camera_delay))
      return;
    const double delay_s = belief().mean[model_.layout.place(TwinParameter::camera_delay)],
                 shift_s = model_.camera.reference_delay_s - delay_s;
    if (std::abs(shift_s) < options_.delay_tolerance_s)
      return;
    model_.camera.reference_delay_s = delay_s;
    filter_.retime([shift_s](const double time_s) { return time_s + shift_s; });
  }

  void SwimmerTwin::watch_for_jumps()
  {
    const auto finding = filter_.latest().jumps.most_likely(quiet_until_s_);
    if (!finding || is_searching_ || finding->ratio < options_.jumps.threshold)
      return;
    if (finding->ratio < finding->runner_up + options_.jumps.margin && finding->ratio < 3. * options_.jumps.threshold)
      return; // more frames will tell
    const JumpHypothesis &hypothesis = hypotheses_[static_cast<std::size_t>(finding->hypothesis)];
    alarm_                           = JumpAlarm{hypothesis.name, *finding, now_s()};
    filter_.widen(finding->since_s, finding->since_s + options_.jumps.interval_s, finding->size * hypothesis.direction);
    quiet_until_s_ = now_s() + options_.jumps.settle_s;
  }

  std::vector<UnlearnedDirection> SwimmerTwin::unlearned() const
  {
    std::vector<UnlearnedDirection> directions;
    const int                       n = model_.layout.n_swimmer(), m = model_.layout.n_states() - n;
    if (!has_started() || m == 0)
      return directions;
    // In units of what the prior would be by now without observations.
    Eigen::VectorXd          unit(m);
    std::vector<std::string> names;
    for (int i = 0; i < n_twin_parameters; ++i)
      if (const auto p = static_cast<TwinParameter>(i); model_.layout.is_estimated(p))
      {
        const DriftingParameter &parameter         = options_.parameters[p];
        const bool               follows_viscosity = p == TwinParameter::stiffness || p == TwinParameter::magnetization;
        const double walked = std::hypot(parameter.drift, follows_viscosity ? options_.parameters.viscosity_drift : 0.);
        unit[model_.layout.place(p) - n] =
            std::hypot(parameter.standard_deviation, walked * std::sqrt(std::max(0., now_s() - started_s_)));
        names.emplace_back(twin_parameter_names[static_cast<std::size_t>(i)]);
      }
    const Eigen::MatrixXd scaled = unit.cwiseInverse().asDiagonal() * belief().root.bottomRows(m);
    const SymmetricEigen  eigen  = symmetric_eigen(scaled * scaled.transpose());
    for (Eigen::Index k = 0; k < m; ++k)
    {
      constexpr double hardly_learned = 0.9, matters = 0.2;
      if (eigen.values[k] < hardly_learned)
        continue;
      UnlearnedDirection direction;
      direction.variance_left = std::min(1., eigen.values[k]);
      for (Eigen::Index i = 0; i < m; ++i)
        if (std::abs(eigen.vectors(i, k)) > matters)
          direction.direction.emplace_back(names[static_cast<std::size_t>(i)], eigen.vectors(i, k));
      std::sort(direction.direction.begin(), direction.direction.end(),
                [](const auto &a, const auto &b) { return std::abs(a.second) > std::abs(b.second); });
      directions.push_back(std::move(direction));
    }
    return directions;
  }

  void SwimmerTwin::watch_for_loss()
  {
    if (has_used_sighting(filter_.latest().innovations))
      last_used_s_ = now_s();
    if (now_s() - last_used_s_ <= options_.search_pose_after_s || filter_.latest().innovations.empty())
      return;
    look_for_pose();
    last_used_s_ = now_s();
  }

  void SwimmerTwin::forget_pose()
  {
    if (!has_started())
      return;
    const int       n = model_.layout.n_swimmer(), k = model_.layout.n_states() - n;
    Eigen::MatrixXd rows = belief().root.bottomRows(k).transpose();
    Eigen::VectorXd workspace(k);
    triangularise(rows, workspace);
    kept_parameters_ = Belief{belief().mean.tail(k), rows.topRows(k).transpose()};
    filter_.stop();
    start_frames_.clear();
    is_searching_ = false;
  }

  /// Frames are used again after none could be: pose and shape may be anything near where they were thought to be. For
  /// half a period nothing is taken for an outlier: far off is what little is known of the parameters.
  void SwimmerTwin::look_for_pose()
  {
    filter_.gated_from_s       = now_s() + options_.search_pose_after_s;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model_.layout.n_states());
    for (int i = 0; i < model_.swimmer.n_velocities(); ++i)
    {
      Eigen::VectorXd direction = zero;
      direction[i]              = i < 2    ? model_.swimmer.length_m()
                                  : i == 2 ? options_.start.angle_sd_rad
                                           : options_.start.shape_sd_m[i - 3];
      filter_.widen(now_s(), now_s(), direction);
    }
    quiet_until_s_ = now_s() + options_.jumps.settle_s;
  }

  SwimmerTwin::Memory SwimmerTwin::memory() const
  {
    const FilterNode &first = filter_.node(0);
    Memory            memory{first.time_s,   started_s_,           quiet_until_s_,
                  last_used_s_,   filter_.gated_from_s, model_.camera.reference_delay_s,
                  first.filtered, first.noise_levels,   {},
                  start_frames_,  is_searching_,        kept_parameters_};
    for (int i = 1; i < filter_.n_nodes(); ++i)
      if (const FilterNode &node = filter_.node(i); !node.observations.empty())
        memory.frames.push_back({node.time_s, node.observations});
    return memory;
  }

  void SwimmerTwin::restore(const Memory &memory)
  {
    model_.camera.reference_delay_s = memory.reference_delay_s;
    filter_.gated_from_s            = memory.gated_from_s;
    filter_.start(memory.window_start_s, memory.at_window_start,
                  JumpTest(hypotheses_, options_.jumps.interval_s, options_.jumps.n_instants), &memory.noise_levels);
    for (const Frame &frame : memory.frames)
      filter_.add(frame);
    last_used_s_     = memory.last_used_s;
    started_s_       = memory.started_s;
    quiet_until_s_   = std::max(memory.quiet_until_s, now_s());
    start_frames_    = memory.start_frames;
    is_searching_    = memory.is_searching;
    kept_parameters_ = memory.kept_parameters;
  }
} // namespace swimtwin
