// The TOML file beside observations: where they come from and how they were measured.
#pragma once

#include <datasets/scene/field_program.h>
#include <datasets/tracks/data_problems.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// How a tracked head is turned into displacements.
  struct Camera
  {
    std::optional<std::array<double, 2>> head_first;       ///< direction in the coordinates of the track
    std::optional<double>                position_sigma_m; ///< standard deviation of one position
    std::optional<double>                pixel_m, frame_s; ///< of a track in pixels and frames
    std::string                          length_unit;      ///< of a table that does not say its own; may be "pixel"
    std::string                          time_unit;        ///< likewise
    double                               least_likelihood = 0.6; ///< of a position by DeepLabCut, whose default it is
    std::optional<double>                period_start_s;         ///< when period 1 begins, phase 0 of the field
    int                                  skipped_periods = 0;    ///< before the motion is taken as periodic
  };

  /// One file of a track.
  struct Recording
  {
    std::filesystem::path file;
    double                frequency_Hz   = 0.;
    double                period_start_s = 0.;
    std::vector<int>      track_ids;                       ///< pieces of one track; none: the only one
    std::string           where;                           ///< of its entry in the sidecar
    std::string           body_part = {}, individual = {}; ///< of DeepLabCut
  };

  struct ObservationSidecar
  {
    std::filesystem::path  file;
    std::filesystem::path  table; ///< that it belongs to, beside it; empty if it does not say
    std::string            source, swimmer, measured_by;
    bool                   synthetic = false, has_inertia = true; ///< computed; of swimmer and fluid
    std::optional<int>     dimension;                             ///< of a computed swimmer, if it says
    std::optional<int>     period;                                ///< none: the periodic state
    std::optional<double>  body_length_m, temperature_C;
    FieldProgram           field;
    std::optional<Camera>  camera;
    std::vector<Recording> recordings;
  };

  /// Read a sidecar; every problem is noted. What could not be read keeps its default.
  ObservationSidecar read_observation_sidecar(const std::filesystem::path &file, DataProblems &problems);
} // namespace swimtwin
