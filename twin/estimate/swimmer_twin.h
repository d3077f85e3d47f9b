// The estimator: where the swimmer is, how bent, what it became.
#pragma once

#include <twin/estimate/twin_model.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Something changed at once.
  struct JumpAlarm
  {
    std::string name;
    JumpFinding finding;
    double      found_s = 0.;
  };

  /// Direction in the estimated parameters (of unit length, each in units of its prior's standard deviation), and the
  /// share of the prior's variance that is left.
  struct UnlearnedDirection
  {
    std::vector<std::pair<std::string, double>> direction; ///< entries that matter, largest first
    double                                      variance_left = 1.;
  };

  /// Whether one of them was used; where there are positions, one of those: an angle alone finds no swimmer.
  bool has_used_sighting(const std::vector<Innovation> &innovations);

  /// Stays where it is made: its parts know each other. One thread.
  class SwimmerTwin
  {
  public:
    SwimmerTwin(const ReducedModel &model, const TwinOptions &options);
    SwimmerTwin(const SwimmerTwin &)            = delete;
    SwimmerTwin &operator=(const SwimmerTwin &) = delete;

    /// What the coils play. A change of what was played earlier than the latest observation is made good by going
    /// through the window again.
    FieldSignal       &field() { return model_.field; }
    const FieldSignal &field() const { return model_.field; }
    void               field_changed_from(double time_s) { revisit_from_s_ = std::min(revisit_from_s_, time_s); }

    /// Stamped by the camera's clock. The first frame that has a position starts the estimate; one that it has
    /// overtaken starts it again.
    Insertion see(double stamp_s, const std::vector<Sighting> &observations);
    /// Whether a frame is of a time before all that the estimate rests on.
    bool is_too_old(double stamp_s, const std::vector<Sighting> &observations) const;

    bool   has_started() const { return filter_.has_started(); }
    bool   is_searching_delay() const { return is_searching_; }
    double now_s() const { return filter_.latest().time_s; } ///< instant of the latest frame
    double started_s() const { return started_s_; }

    const Belief         &belief() const { return filter_.latest().filtered; }
    const WindowFilter   &filter() const { return filter_; }
    WindowFilter         &filter() { return filter_; }
    const TwinLayout     &layout() const { return model_.layout; }
    TwinProcess          &process() { return model_.process; }
    const CameraSensor   &camera() const { return model_.camera; }
    CameraSensor         &camera() { return model_.camera; }
    const ReducedSwimmer &swimmer() const { return model_.swimmer; }
    const TwinOptions    &options() const { return options_; }

    /// The alarm that the last frame raised, if it did; the estimate has been widened to follow.
    const std::optional<JumpAlarm> &alarm() const { return alarm_; }
    /// Directions of which less than a tenth of the prior's variance went: they keep their prior.
    std::vector<UnlearnedDirection> unlearned() const;

    /// Begin anew with the next frame that shows the head; what was learned of the parameters stays.
    void forget_pose();

    /// What a later program needs to go on: the window's beginning and what was seen in it.
    struct Memory
    {
      double window_start_s = 0., started_s = 0., quiet_until_s = 0., last_used_s = 0., gated_from_s = -1e300;
      double reference_delay_s = 0.;
      Belief at_window_start;
      std::array<NoiseLevel, max_observation_kinds> noise_levels;
      std::vector<Frame>                            frames;       ///< at instants, within the window
      std::vector<Frame>                            start_frames; ///< with stamps, while the delay is searched for
      bool                                          is_searching = false;
      std::optional<Belief>                         kept_parameters; ///< of before the pose was forgotten
    };
    Memory memory() const;
    void   restore(const Memory &memory);

  private:
    void   start(double instant_s, const std::vector<Sighting> &observations);
    bool   was_overtaken(double instant_s, const std::vector<Sighting> &observations) const;
    void   start_earlier(double instant_s, const std::vector<Sighting> &observations);
    Belief first_belief(double instant_s, const std::vector<Sighting> &observations) const;
    void   search_delay();
    double run_through_start(double delay_s);
    void   keep_delay_reference();
    void   watch_for_jumps();
    void   watch_for_loss();
    void   look_for_pose();

    TwinOptions  options_;
    TwinModel    model_;
    WindowFilter filter_;

    std::vector<JumpHypothesis> hypotheses_;
    std::optional<JumpAlarm>    alarm_;
    std::optional<Belief>       kept_parameters_; ///< of before the pose was forgotten
    std::vector<Frame>          start_frames_;    ///< with stamps, while the delay is searched for
    double                      started_s_ = 0., quiet_until_s_ = 0.;
    double                      last_used_s_    = 0.;
    double                      revisit_from_s_ = std::numeric_limits<double>::infinity();
    bool                        is_searching_   = false;
  };
} // namespace swimtwin
