// What an imagined laboratory is like: swimmer, fluid, coils and camera, with all that goes wrong there.
#pragma once

#include <twin/motion/twin_process.h>

#include <string>
#include <utility>
#include <vector>

namespace swimtwin
{
  /// From one instant to another.
  struct TimeSpan
  {
    double from_s = 0., to_s = 0.;
    bool   contains(const double time_s) const { return time_s >= from_s && time_s < to_s; }
  };

  struct LaboratoryCamera
  {
    double                frames_per_second = 30.;
    double                position_sigma_m = 0., angle_sigma_rad = 0.;
    bool                  sees_angle = true;
    std::vector<double>   tail_shares;           ///< named points of the tail that it sees
    double                latency_s        = 0.; ///< from the stamp until a frame arrives
    double                latency_jitter_s = 0.; ///< standard deviation of it: frames overtake each other
    double                missing_share = 0., outlier_share = 0.;
    double                outlier_m = 0.; ///< how far an outlier is off
    std::vector<TimeSpan> dark, stuck;    ///< no frames; the same values again and again
  };

  struct LaboratoryCoils
  {
    double lag_s          = 0.; ///< of first order
    double quantisation_T = 0.; ///< step of the output
  };

  /// The fluid warms up at this rate; viscosity falls with it.
  struct TemperatureRamp
  {
    double start_s = 0., end_s = 0., rate_K_s = 0.;
    double viscosity_per_K = -0.09; ///< of its logarithm; glycerol
  };

  /// E/mu or M/mu changes by a factor at once.
  struct SuddenChange
  {
    double        time_s    = 0.;
    TwinParameter parameter = TwinParameter::stiffness;
    double        change    = 0.; ///< added to the parameter
  };

  struct LaboratoryOptions
  {
    SwimmerParameters         nominal;
    InertialDensities         densities = {}; ///< inertia that its swimmer carries
    TwinParameters            truth;          ///< values and drifts; standard deviations do not matter
    ModelNoise                noise;          ///< of its motion
    Eigen::VectorXd           first_state;    ///< of the swimmer; empty: straight, at rest
    LaboratoryCamera          camera;
    LaboratoryCoils           coils;
    TemperatureRamp           ramp;
    std::vector<SuddenChange> changes;
    double                    largest_step_s = 1. / 60.;
    unsigned int              seed           = 1;
  };
} // namespace swimtwin
