// Steers the swimmer along a path by what the twin knows of it: one decision after the other, what to play, until when.
#pragma once

#include <twin/steering/coil_limiter.h>
#include <twin/steering/recent_motion.h>
#include <twin/steering/steering_config.h>

#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  enum class SteeringPhase {
    blind,     ///< the swimmer is not seen: the safe field
    warming,   ///< straight ahead, until it swims steadily and the path can be laid
    following, ///< along the path
    arrived,   ///< at its end: the safe field
    ended      ///< its time is over: the safe field
  };
  const char *to_string(SteeringPhase phase);

  /// What the coils are to play from an instant on.
  struct PlayRecord
  {
    double                   time_s = 0., until_s = 0.; ///< the samples after it lead to the safe field
    std::vector<FieldSample> samples;
    SteeringPhase            phase     = SteeringPhase::blind;
    double                   decided_s = 0.;                      ///< the instant at which the swimmer was looked at
    double                   took_s    = 0.;                      ///< of the wall clock
    bool                     is_late   = false;                   ///< or no decision was found: the last plan goes on
    Eigen::Vector2d          mean_m    = Eigen::Vector2d::Zero(); ///< position over the last period, as estimated
    Eigen::Vector2d          path_m    = Eigen::Vector2d::Zero(); ///< nearest point of the path
    double                   arc_m     = 0.;
    double                   doubt_m   = 0.; ///< standard deviation of the position when the decision begins to act
  };

  /// Stays where it is made, beside its twin. One thread.
  class Pilot
  {
  public:
    /// `twin` must live as long. Throws InputError for a path that the twin's swimmer cannot follow.
    Pilot(SwimmerTwin &twin, const ReducedModel &model, const SteeringConfig &config);

    double interval_s() const { return 1. / config_.goal.options.decisions_per_second; }
    bool   is_due(const double now_s) const { return now_s >= next_s_ - 1e-9; }
    /// What to play from one interval later on; the twin's own field knows of it. `has_sight`: whether frames can be
    /// used.
    PlayRecord decide(double now_s, bool has_sight);
    /// The clock began anew.
    void forget_time() { next_s_ = -1e300; }

    SteeringPhase        phase() const { return phase_; }
    bool                 has_path() const { return path_.has_value(); }
    const Path          &path() const { return *path_; } ///< where it lies in the laboratory
    const Path          &wanted_path() const { return config_.goal.path; }
    const CarrierMotion &motion() const { return motion_; }

    /// Whether the carrier plays, along the path or towards its beginning; if so how far it is turned at an instant,
    /// and when its phase was 0, at most a period before it began to play.
    bool   plays_carrier() const { return phase_ == SteeringPhase::warming || phase_ == SteeringPhase::following; }
    double carrier_angle_rad(const double time_s) const { return plan_.angle_rad(clock_.periods(time_s)); }
    double carrier_start_s() const { return clock_.origin_s; }

    /// What a later program needs to go on along the same path.
    struct Memory
    {
      int             phase = 0, has_path = 0;
      double          angle_rad = 0., ends_s = 0., arc_m = 0.; ///< of the path; when its time is over; how far along it
      double          origin_s = 0.;                           ///< of the carrier
      Eigen::VectorXd place_m  = Eigen::VectorXd::Zero(2);     ///< of the path's beginning
    };
    Memory memory() const;
    void   restore(const Memory &memory);

  private:
    bool                        is_over() const;
    void                        begin_plan(const RecentMotion &recent, double now_s);
    void                        lay_path(const Eigen::Vector2d &place_m, double angle_rad);
    std::optional<RecentMotion> look(double now_s);
    void                        go_on(double now_s, double start_s, PlayRecord &record);
    void                        steer(const RecentMotion &recent, double now_s, double start_s, PlayRecord &record);
    bool                        improve(const RecentMotion &recent, double now_s, double start_s, PlayRecord &record);
    double                      doubt_m(const RecentMotion &recent, double now_s);
    Eigen::Vector2d             wanted_T(double time_s) const;
    void                        compose(PlayRecord &record);

    SwimmerTwin                &twin_;
    ReducedSwimmer              swimmer_; ///< that plans are made with
    SteeringConfig              config_;
    CarrierMotion               motion_;
    CoilLimiter                 limiter_;
    SteeringPhase               phase_ = SteeringPhase::blind;
    PeriodClock                 clock_; ///< of the plan
    SteeringPlan                plan_;
    std::optional<Path>         path_;
    std::optional<PathFollower> follower_;
    Memory                      laid_; ///< how the path lies
    double                      next_s_ = -1e300, warming_since_s_ = 0., ends_s_ = 0., arc_m_ = 0., decided_s_ = 0.;
  };
} // namespace swimtwin
