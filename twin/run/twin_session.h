// A conversation with the twin: lines in, lines out. No files, no clocks: the same lines give the same answers.
#pragma once

#include <twin/stream/records.h>
#include <twin/stream/twin_config.h>

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string_view>

namespace swimtwin
{
  class TwinSession
  {
  public:
    /// `say` gets each line of the answer, without its line break; `note` each estimate made from a frame, `steered`
    /// each decision.
    struct Listeners
    {
      std::function<void(const std::string &)>    say     = [](const std::string &) {};
      std::function<void(const EstimateRecord &)> note    = [](const EstimateRecord &) {};
      std::function<void(const PlayRecord &)>     steered = [](const PlayRecord &) {};
    };

    /// `model` must live as long.
    TwinSession(const ReducedModel &model, const TwinConfig &config, Listeners listeners);

    void greet();
    /// One line of the stream. What is wrong with it is answered by an error line, which begins with `where` it is
    /// from.
    void take(std::string_view line, std::string_view where = {});
    /// A line that cannot be taken at all, for the reason that the sentence says. It counts.
    void refuse_line(const std::string &sentence);
    /// No line came for this time, by the wall clock. Nothing to one whose stream has a clock of its own.
    void wait(double since_last_line_s);
    /// A line of before a kill, or one that was said then: nothing is decided again.
    void take_again(std::string_view line);
    void finish();

    bool                has_ended() const { return has_ended_; }
    const StreamCounts &counts() const { return counts_; }
    const SwimmerTwin  &twin() const { return twin_; }
    bool                proposes_fields() const { return telling_.has_value(); }
    const Pilot        *pilot() const { return pilot_ ? &*pilot_ : nullptr; } ///< null if the twin only watches

    /// All that a later session needs to go on as if nothing had happened; null before the first frame.
    nlohmann::ordered_json memory() const;
    /// Throws InputError for what memory() did not write.
    void restore(const nlohmann::ordered_json &memory);

  private:
    void see(Frame frame);
    void hear(const FieldSample &sample);
    void hear(const DriveMessage &drive);
    void hear(const PlayMessage &play);
    void hear(const ClockMessage &clock);
    void come_to(double time_s);
    void forget_old_field();
    void restart();
    void require_plausible_time(const Frame &frame);
    void answer_frame(const Frame &frame);
    void tell(const std::vector<Alarm> &alarms, double time_s);
    void tell_now_and_then();
    void forecast();
    void smooth();
    void propose_field();
    void refuse(const std::string &sentence);

    const ReducedModel          &model_;
    TwinConfig                   config_;
    Listeners                    listeners_;
    SwimmerTwin                  twin_;
    Watchdog                     watchdog_;
    std::optional<Pilot>         pilot_;
    std::optional<TellingSearch> telling_;
    StreamCounts                 counts_;
    bool                         has_ended_       = false;
    double                       next_forecast_s_ = -1e300, next_open_s_ = -1e300, next_proposal_s_ = -1e300;
    int                          n_refused_in_a_row_ = 0;
    bool                         has_clock_ = false, is_repeating_ = false;
    /// The latest time that is known to have come, and when the last line was done.
    double clock_s_ = -1e300, clock_at_last_line_s_ = -1e300;
  };
} // namespace swimtwin
