// A swimmer led along a path by decisions in real time, from what a camera sees of it.
#pragma once

#include <control/steering/axis_swing.h>
#include <control/steering/path_follower.h>
#include <control/steering/plant.h>

#include <functional>
#include <optional>

namespace swimtwin
{
  /// A point of the body that is to go along a path, in the swimmer's frame as that of its front, which is led.
  struct LedPoint
  {
    double behind_m = 0.; ///< the head's centre
    Path   path     = Path::line(1.);
  };

  struct ClosedLoopOptions
  {
    FollowerOptions follower             = {};
    double          decisions_per_second = 20.;
    double          deadline_s      = 0.05; ///< CPU time of a decision; a later one is not used, the last plan goes on
    double          position_noise  = 0.;   ///< standard deviation of what is measured, body lengths
    double          angle_noise_rad = 0.;
    double          delay_s         = 0.; ///< a pose is seen so late; the observer takes it for the present one
    double          position_gain = 0.15, angle_gain = 0.15; ///< of the observer: share of what is measured
    unsigned int    seed                               = 1;
    double          warm_up_periods                    = 3.;    ///< from rest, straight ahead, before the path begins
    double          max_periods                        = 2000.; ///< on the path
    double          end_distance                       = 0.01;  ///< body lengths from the path's end: arrived
    std::optional<LedPoint>                point       = {};    ///< if it is not the head that shall be on the path
    std::function<void(double share_done)> on_progress = {};
  };

  /// One row per decision. Positions: head's centre; mean: over the last period.
  struct TrackedInstant
  {
    double          time_s = 0.;
    Pose            pose, measured, estimated;
    Eigen::Vector2d mean_m, path_m;
    double          arc_m = 0., distance_m = 0.; ///< of the true mean position
    double          heading_error_rad = 0.;      ///< of the mean angle against the path's direction
    double          decision_cpu_s    = 0.;
    bool            decided           = false; ///< in time
    Eigen::Vector2d field_T;
  };

  enum class TrackStatus { not_run, arrived, not_arrived, failed };
  std::string to_string(TrackStatus status);

  struct TrackResult
  {
    TrackStatus status = TrackStatus::not_run;
    std::string message; ///< one sentence, unless arrived

    Path                        path = Path::line(1.); ///< where it lies
    SteeringPlan                plan;                  ///< as played
    std::vector<TrackedInstant> instants;              ///< on the path
    double                      start_periods = 0., end_periods = 0., lever_m = 0., advance_m = 0.;

    double                 rms_distance_m = 0., largest_distance_m = 0.; ///< of the mean position
    double                 rms_swing_m     = 0.;                         ///< of the head itself about the path
    double                 rms_heading_rad = 0.;
    double                 rms_point_m     = 0.; ///< instantaneous, of the options' point from its own path
    std::vector<AxisPoint> axis;                 ///< how points behind the head swing; empty for less than two periods
    double                 mean_decision_s = 0., largest_decision_s = 0.;
    int                    n_decisions = 0, n_missed = 0;
  };

  /// How the model swims in a carrier: its periodic motion, per period and when the field turns.
  struct CarrierMotion
  {
    double advance_m = 0.; ///< head first, per period
    double lever_m   = 0.; ///< from the head to the point about which the body turns
  };
  /// Throws ComputationError where there is no stable periodic motion.
  CarrierMotion carrier_motion(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters,
                               const Drive &carrier);

  /// The path begins where the swimmer is on average after the warm-up, along its heading there. `model_parameters` are
  /// what the decisions believe. Throws InputError for a path that cannot be followed.
  TrackResult run_closed_loop(const ReducedSwimmer &model, const SwimmerParameters &model_parameters,
                              const Drive &carrier, const Path &path, Plant &plant,
                              const ClosedLoopOptions &options = {});

  /// A plan that was found before, played blindly, and how far from its own path that leads the plant.
  TrackResult play_plan(const ReducedSwimmer &model, const SwimmerParameters &model_parameters,
                        const TrackResult &planned, Plant &plant, const ClosedLoopOptions &options = {});

  /// On the model itself, without noise and deadline: a plan that can be played blindly.
  TrackResult follow_path(const ReducedSwimmer &model, const SwimmerParameters &parameters, const Drive &carrier,
                          const Path &path, ClosedLoopOptions options = {});
} // namespace swimtwin
