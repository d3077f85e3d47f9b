// The configuration of a twin, written in TOML.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/swimmer/driving_field.h>
#include <twin/estimate/twin_options.h>
#include <twin/steering/steering_config.h>
#include <twin/telling/telling_options.h>
#include <twin/watch/watch_options.h>

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

namespace swimtwin
{
  /// What frames lack, and how they are to be read.
  struct CameraConfig
  {
    double                        position_sigma_m = 0., angle_sigma_rad = 0.; ///< 0: learned
    bool                          y_down = false; ///< as in pictures: y grows downwards, angles clockwise
    std::map<std::string, double> points;         ///< named points of the tail: shares of its axis
  };

  struct OutputConfig
  {
    double forecast_periods = 2.; ///< 0: none
    double forecast_every_s = 1.;
    double smoothing_lag_s  = 0.; ///< 0: none
  };

  struct TwinConfig
  {
    std::string                   text;
    TwinOptions                   options;
    bool                          states_inertia = false; ///< or leaves the choice to what there is
    WatchOptions                  watch;
    CameraConfig                  camera;
    OutputConfig                  output;
    std::optional<Drive>          drive; ///< that plays from `drive_start_s` on; the stream may change it
    double                        drive_start_s = 0.;
    double                        period_s      = 1.;  ///< of the drive, or as stated: the scale of time
    double                        largest_gap_s = 60.; ///< a frame later than that after the last one is not believed
    int                           save_every    = 300; ///< lines
    std::filesystem::path         prior, field_file;   ///< a calibration.json, a field program; empty: none
    std::optional<SteeringConfig> steering;            ///< what to do with the swimmer; none: to watch it
    std::optional<TellingOptions> telling;             ///< of which parameter another field would tell more

    /// Read beside the configuration itself.
    std::vector<std::filesystem::path> files() const;
  };

  /// What the file leaves out is the model's scene's, or a default. Throws InputError with file, line, key, rule and
  /// remedy.
  TwinConfig read_twin_config(const std::filesystem::path &file, const ReducedModel &model);
} // namespace swimtwin
