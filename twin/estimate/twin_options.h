// What a twin is to estimate, and what it is told at the start.
#pragma once

#include <rom/swimmer/swimmer_parameters.h>
#include <twin/filter/window_filter.h>
#include <twin/measurement/camera_sensor.h>
#include <twin/motion/twin_process.h>

#include <optional>

namespace swimtwin
{
  /// Of the swimmer when it is first seen. Standard deviations of pose and shape.
  struct StartBelief
  {
    std::optional<double> angle_rad; ///< of the head in the laboratory; none: seen, or along the field
    double                angle_sd_rad = 0.5;
    Eigen::VectorXd       shape_sd_m;    ///< from straight, of each mode
    double                period_s = 1.; ///< in which a swimmer with inertia may move as far as it may be off
  };

  struct JumpOptions
  {
    double interval_s = 0.6; ///< between instants at which something may have happened
    int    n_instants = 8;   ///< how many of them are thought of
    /// Twice the log of the likelihoods' ratio that is an alarm: with a chi-squared of one degree of freedom and a
    /// hundred tries per period, 45 is passed once in 1e8 periods by chance; the model's own error asks for more.
    double threshold = 60.;
    /// By so much the ratio is ahead of any other explanation's, unless it is three times the threshold.
    double margin   = 15.;
    double settle_s = 3.; ///< after the start and after an alarm, before the next one
  };

  struct TwinOptions
  {
    SwimmerParameters nominal;        ///< where the logarithms are 0
    InertialDensities densities = {}; ///< inertia that the swimmer carries
    TwinParameters    parameters;
    ModelNoise        noise;
    /// Covariance of log(E/mu) and log(M/mu) that the model's own error leaves (see model_bias.h): no part of the
    /// filter, but of what is said of the parameters.
    Eigen::Matrix2d ratio_bias = Eigen::Matrix2d::Zero();
    FilterOptions   filter;
    FirstSigmas     first_sigmas;
    StartBelief     start;
    JumpOptions     jumps;
    double          largest_step_s = 1. / 30.;
    /// Frames come and none of them could be used for this time: the pose is searched for anew.
    double search_pose_after_s = 0.6;
    /// An unknown delay is searched for with all that was seen in this time.
    double delay_search_s      = 4.;
    double delay_search_step_s = 0.025;
    /// The estimated delay may be off the one that instants were made with by this.
    double delay_tolerance_s = 0.003;
  };

  /// Relative, of the displacement in the held-out runs; a model without any is taken to be 1 % off.
  double held_out_displacement_error(const ReducedModel &model);

  /// Sensible sizes for a swimmer in a field of this frequency; everything else is the user's.
  TwinOptions default_twin_options(const ReducedModel &model, const SwimmerParameters &nominal, double frequency_Hz);
} // namespace swimtwin
