// What the filter would know after some time of a field: its covariance depends on the motion that is expected, not on
// what will be seen.
#pragma once

#include <twin/estimate/swimmer_twin.h>
#include <twin/telling/carrier_change.h>

#include <optional>

namespace swimtwin
{
  struct TrialResult
  {
    double standard_deviation = 0.; ///< of the parameter, at the end
    double speed_m_s          = 0.; ///< of the head after it, mean over whole periods, about as long again
  };

  class FieldTrial
  {
  public:
    /// `model` must live as long.
    FieldTrial(const ReducedModel &model, const TwinOptions &options);

    /// What a twin knows and sees now, and the drive that plays from `drive_start_s` on, with phase 0 there.
    void begin(const SwimmerTwin &twin, const Drive &drive, double drive_start_s);

    /// After a duration in the changed drive, which goes on in the phase that the drive has now. None if there is no
    /// way on.
    std::optional<TrialResult> run(const FieldChange &change, TwinParameter parameter, double duration_s);

  private:
    bool                  take_in_frame(double time_s);
    std::optional<double> mean_speed(double frequency_Hz, double duration_s);

    TwinModel             model_;
    SquareRootFilter      algebra_;
    Belief                now_, belief_;
    double                now_s_ = 0., frame_interval_s_ = 0.;
    std::vector<Sighting> seen_; ///< of a usual frame, with sigmas
    Drive                 drive_;
    double                drive_start_s_ = 0.;
    Eigen::MatrixXd       transition_, noise_, slopes_; ///< memory
    Eigen::VectorXd       residual_;
    UpdateRecord          record_;
  };
} // namespace swimtwin
