// Watchdogs: when not to believe the estimate, since when, and what to do.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>
#include <twin/estimate/swimmer_twin.h>
#include <twin/watch/watch_options.h>

#include <array>
#include <deque>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Alarms that last, as flags name them; the last one is of the session.
  namespace watch_flag
  {
    inline constexpr const char *inconsistent = "inconsistent", *outside_trained_region = "outside-trained-region",
                                *near_wall = "near-wall", *step_out = "step-out", *frozen = "frozen",
                                *sight_lost = "sight-lost", *searching_delay = "searching-delay";
  }
  inline constexpr std::array watch_flags = {watch_flag::inconsistent,   watch_flag::outside_trained_region,
                                             watch_flag::near_wall,      watch_flag::step_out,
                                             watch_flag::frozen,         watch_flag::sight_lost,
                                             watch_flag::searching_delay};

  struct Alarm
  {
    std::string name; ///< a watch_flag, or "jump: " and what jumped
    double      since_s = 0.;
    std::string what, remedy;    ///< sentences
    bool        is_over = false; ///< it was on, and ended now
  };

  class Watchdog
  {
  public:
    /// All must live as long. `drive_period_s`: the scale of time.
    Watchdog(const SwimmerTwin &twin, const ReducedModel &model, const WatchOptions &options, double drive_period_s);

    /// After each frame; `stamp_s` is its stamp, `frame` what it showed. Alarms that begin or end now.
    std::vector<Alarm> look(const Frame &frame, const Eigen::Vector2d &field_T);
    /// Time has gone on without a frame.
    std::vector<Alarm> wait(double time_s);

    /// Names of those that are on.
    std::vector<std::string> flags() const;
    /// 0 to 1: consistency times region times sight (docs/file-formats.md).
    double trust(double time_s) const;
    /// Chi-squared's probability of the last frame's innovations to be that far off.
    double significance() const { return significance_; }

  private:
    bool is_on(const std::string &name) const;
    void judge(const char *name, bool is_bad, double since_s, const std::string &what, const std::string &remedy,
               std::vector<Alarm> &changes);
    void judge_innovations(std::vector<Alarm> &changes);
    void judge_region(std::vector<Alarm> &changes);
    void judge_walls(std::vector<Alarm> &changes);
    void judge_step_out(const Eigen::Vector2d &field_T, std::vector<Alarm> &changes);
    void judge_frozen(const Frame &frame, std::vector<Alarm> &changes);
    void judge_sight(double time_s, std::vector<Alarm> &changes);

    const SwimmerTwin    &twin_;
    std::optional<Domain> domain_;
    WatchOptions          options_;
    double                period_s_;

    std::vector<Alarm>                 on_;
    std::deque<std::pair<double, int>> distances_; ///< chi-squared and its degrees of freedom
    double                             sum_          = 0.;
    int                                n_degrees_    = 0;
    double                             significance_ = 1., consistency_ = 1., shape_radius_ = 0.;
    double                             last_used_s_ = 0., against_since_s_ = 0.;
    std::vector<Sighting>              last_seen_;
    int                                n_same_       = 0;
    double                             same_since_s_ = 0.;
  };
} // namespace swimtwin
