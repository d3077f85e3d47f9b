// A change of the field that tells more of one parameter: proposed, not played.
#pragma once

#include <twin/telling/field_trial.h>
#include <twin/telling/telling_options.h>

namespace swimtwin
{
  struct TellingField
  {
    TwinParameter parameter = TwinParameter::stiffness;
    double        time_s = 0., duration_s = 0.;
    Drive         as_is, proposed;
    FieldChange   change;
    TrialResult   of_as_is, of_proposed;
    bool          is_better = false; ///< else the two are the same: nothing within the limits tells more
  };

  /// Trials with each of bx, by and the frequency changed by a twentieth tell where the interval shortens fastest;
  /// along that direction, less what would change the speed, the longest of a few steps that shortens it and keeps the
  /// limits is proposed. One trial at a time, so that none holds a stream up for long.
  class TellingSearch
  {
  public:
    /// `model` must live as long.
    TellingSearch(const ReducedModel &model, const TwinOptions &twin, const TellingOptions &options);

    const TellingOptions &options() const { return options_; }
    bool                  is_searching() const { return is_searching_; }
    /// From what a twin knows now. The drive plays from `drive_start_s` on, with phase 0 there.
    void begin(const SwimmerTwin &twin, const Drive &drive, double drive_start_s);
    /// The next trial, while searching; what is proposed, after the last one.
    std::optional<TellingField> go_on();
    void                        give_up() { is_searching_ = false; }

  private:
    static constexpr int n_variables = 3;
    using Variables                  = Eigen::Matrix<double, n_variables, 1>; ///< logarithms of the three factors

    FieldChange within_limits(const Variables &x) const;
    /// Of the coils' limits and the largest field: at most 1 where all are kept.
    double                      use_of_limits(const Drive &drive) const;
    std::optional<TrialResult>  trial(const FieldChange &change);
    void                        choose_direction();
    std::optional<TellingField> finish(const FieldChange &change, const TrialResult &result, bool is_better);

    TellingOptions options_;
    FieldTrial     trial_;
    Drive          drive_;
    double         time_s_ = 0., duration_s_ = 0.;
    bool           is_searching_ = false;
    int            n_trials_     = 0;
    TrialResult    as_is_;
    Variables      slopes_ = Variables::Zero(), speed_slopes_ = Variables::Zero(), direction_ = Variables::Zero();
  };
} // namespace swimtwin
