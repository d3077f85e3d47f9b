#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <twin/steering/pilot.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  const char *to_string(const SteeringPhase phase)
  {
    switch (phase)
    {
    case SteeringPhase::blind:
      return "blind";
    case SteeringPhase::warming:
      return "warming";
    case SteeringPhase::following:
      return "following";
    case SteeringPhase::arrived:
      return "arrived";
    case SteeringPhase::ended:
      return "ended";
    }
    return "";
  }

  Pilot::Pilot(SwimmerTwin &twin, const ReducedModel &model, const SteeringConfig &config)
      : twin_(twin), swimmer_(model, twin.options().densities), config_(config),
        motion_(carrier_motion(swimmer_, twin.options().nominal, config.goal.carrier)), limiter_(config.goal.limits)
  {
    require_followable(config.goal.path, motion_.lever_m);
    clock_.frequency_Hz = config.goal.carrier.frequency_Hz;
    plan_.carrier       = config.goal.carrier;
  }

  bool Pilot::is_over() const
  {
    return phase_ == SteeringPhase::arrived || phase_ == SteeringPhase::ended;
  }

  /// Straight ahead as the swimmer points now, until something better is decided. A carrier that was interrupted goes
  /// on in its phase, so that a short interruption does not shift the swimmer's mean position.
  void Pilot::begin_plan(const RecentMotion &recent, const double now_s)
  {
    const ClosedLoopOptions &options = config_.goal.options;
    const double             knots =
        (options.warm_up_periods + options.max_periods + options.follower.horizon_periods) / plan_.knot_periods;
    clock_.origin_s  = has_path() ? clock_.origin_s + std::floor(clock_.periods(now_s)) / clock_.frequency_Hz : now_s;
    warming_since_s_ = decided_s_ = now_s;
    plan_.angles_rad =
        Eigen::VectorXd::Constant(static_cast<Eigen::Index>(std::ceil(knots)) + 8, recent.mean_angle_rad());
    phase_ = has_path() ? SteeringPhase::following : SteeringPhase::warming;
  }

  void Pilot::lay_path(const Eigen::Vector2d &place_m, const double angle_rad)
  {
    laid_.place_m   = place_m;
    laid_.angle_rad = angle_rad;
    laid_.has_path  = 1;
    path_           = config_.goal.path.placed(angle_rad, place_m);
    follower_.emplace(swimmer_, twin_.options().nominal, *path_, motion_.advance_m, config_.goal.options.follower);
  }

  std::optional<RecentMotion> Pilot::look(const double now_s)
  {
    return recent_motion(twin_, clock_, std::max(now_s, twin_.has_started() ? twin_.now_s() : now_s));
  }

  /// Of the head's position when what is decided now begins to act, the larger half axis.
  double Pilot::doubt_m(const RecentMotion &recent, const double now_s)
  {
    Belief ahead = recent.now;
    if (!twin_.filter().predict(now_s, now_s + interval_s(), ahead))
      ahead = recent.now;
    const Eigen::Matrix2d covariance = ahead.root.topRows<2>() * ahead.root.topRows<2>().transpose();
    const double          half_trace = 0.5 * covariance.trace();
    return std::sqrt(half_trace + std::sqrt(std::max(0., half_trace * half_trace - covariance.determinant())));
  }

  /// One step of the plan's improvement. False if there is none, or none in time.
  bool Pilot::improve(const RecentMotion &recent, const double now_s, const double start_s, PlayRecord &record)
  {
    SteeringPlan improved = plan_;
    record.doubt_m        = doubt_m(recent, now_s);
    improved.background_T = twin_.process().background_T(recent.now.mean);
    follower_->believe(twin_.process().parameters(recent.now.mean), config_.weighs_doubt ? record.doubt_m : 0.);
    const SwimmerState state = recent.now.mean.head(swimmer_.n_states());
    const double       now   = recent.position_m.now();
    const FollowerStep decision =
        follower_->improve(improved, now, now + interval_s() * clock_.frequency_Hz, state, recent.position_m, arc_m_);
    const double limit_s = config_.goal.options.deadline_s;
    if (!decision.completed || (limit_s > 0. && wall_time_s() - start_s > limit_s))
      return false;
    plan_      = std::move(improved);
    arc_m_     = decision.arc_m;
    decided_s_ = now_s;
    return true;
  }

  void Pilot::steer(const RecentMotion &recent, const double now_s, const double start_s, PlayRecord &record)
  {
    const ClosedLoopOptions &options  = config_.goal.options;
    const double             period_s = 1. / clock_.frequency_Hz, length_m = twin_.swimmer().length_m();
    record.mean_m = recent.position_m.mean_at(recent.position_m.now());
    if (phase_ == SteeringPhase::warming && now_s >= warming_since_s_ + options.warm_up_periods * period_s &&
        !twin_.is_searching_delay() && recent.position_m.has_period())
    {
      lay_path(record.mean_m, std::numbers::pi + recent.mean_angle_rad());
      phase_     = SteeringPhase::following;
      ends_s_    = now_s + options.max_periods * period_s;
      decided_s_ = now_s;
    }
    if (phase_ != SteeringPhase::following)
      return;
    // Until a period was seen there is no mean position; the plan goes straight on.
    if (recent.position_m.has_period())
      record.is_late = !improve(recent, now_s, start_s, record);
    record.path_m = path_->nearest(record.mean_m, arc_m_, std::min(arc_m_ + 0.5 * length_m, path_->length_m())).point_m;
    record.arc_m  = arc_m_;
    if (path_->length_m() - arc_m_ <= options.end_distance * length_m)
      phase_ = SteeringPhase::arrived;
    else if (now_s >= ends_s_)
      phase_ = SteeringPhase::ended;
  }

  /// What is seen leads on; a late decision leaves the last plan, until it is older than its horizon.
  void Pilot::go_on(const double now_s, const double start_s, PlayRecord &record)
  {
    const bool was_blind = phase_ == SteeringPhase::blind;
    auto       recent    = look(now_s);
    if (recent && was_blind)
    {
      begin_plan(*recent, now_s);
      recent = look(now_s); // by the new plan's clock
    }
    if (recent)
      steer(*recent, now_s, start_s, record);
    else
      record.is_late = !was_blind;
    const double horizon_s = config_.goal.options.follower.horizon_periods / clock_.frequency_Hz;
    if (record.is_late && (was_blind || now_s - decided_s_ > horizon_s))
      phase_ = SteeringPhase::blind;
  }

  PlayRecord Pilot::decide(const double now_s, const bool has_sight)
  {
    const double start_s = wall_time_s();
    PlayRecord   record;
    const double next_s = next_s_ + interval_s();
    next_s_             = next_s > now_s ? next_s : now_s + interval_s();
    record.decided_s    = now_s;
    record.time_s       = now_s + interval_s();
    record.until_s      = record.time_s + config_.valid_s;
    if (!is_over())
    {
      if (has_sight)
        go_on(now_s, start_s, record);
      else
        phase_ = SteeringPhase::blind;
    }
    record.phase = phase_;
    compose(record);
    record.took_s = wall_time_s() - start_s;
    return record;
  }

  Eigen::Vector2d Pilot::wanted_T(const double time_s) const
  {
    return plays_carrier() ? plan_.field_T(clock_.periods(time_s)) : config_.safe_T;
  }

  /// From what is played at its beginning on; behind its end to the safe field.
  void Pilot::compose(PlayRecord &record)
  {
    const double    step_s = 1. / config_.sample_rate_Hz;
    const int       n      = static_cast<int>(std::ceil((record.until_s - record.time_s) / step_s - 1e-9));
    FieldSignal    &field  = twin_.field();
    Eigen::Vector2d now_T  = limiter_.limited(field.value_T(record.time_s));
    record.samples.push_back({record.time_s, now_T});
    for (int i = 1; i <= n; ++i)
    {
      const double time_s = i == n ? record.until_s : record.time_s + i * step_s;
      now_T               = limiter_.moved(now_T, wanted_T(time_s), time_s - record.samples.back().time_s);
      record.samples.push_back({time_s, now_T});
    }
    const double way_s = std::max(step_s, limiter_.time_to_move_s(now_T, config_.safe_T));
    record.samples.push_back({record.until_s + way_s, config_.safe_T});
    field.replace(record.samples);
  }

  Pilot::Memory Pilot::memory() const
  {
    Memory memory   = laid_;
    memory.phase    = static_cast<int>(phase_);
    memory.ends_s   = ends_s_;
    memory.origin_s = clock_.origin_s;
    memory.arc_m    = arc_m_;
    return memory;
  }

  /// A plan is begun anew, in the carrier's phase: while no program was there the coils may have gone to the safe
  /// field.
  void Pilot::restore(const Memory &memory)
  {
    if (memory.phase < 0 || memory.phase > static_cast<int>(SteeringPhase::ended) || memory.place_m.size() != 2)
      throw InputError("has a pilot's memory that is none");
    if (memory.has_path != 0)
      lay_path(memory.place_m, memory.angle_rad);
    ends_s_         = memory.ends_s;
    arc_m_          = memory.arc_m;
    clock_.origin_s = memory.origin_s;
    phase_          = static_cast<SteeringPhase>(memory.phase);
    if (!is_over())
      phase_ = SteeringPhase::blind;
  }
} // namespace swimtwin
