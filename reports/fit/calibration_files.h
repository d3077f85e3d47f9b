// The files of a calibration.
#pragma once

#include <calibration/run/fitted_scene.h>
#include <datasets/observation/calibration_result.h>
#include <datasets/scene/scene.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  inline constexpr const char *calibration_result_name = "calibration.json";

  /// All that a calibration writes, to be refused or replaced.
  std::vector<std::string> calibration_file_names();

  /// calibration.json, fitted-scene.toml and the tables parameters.csv, residuals.csv, band.csv, profiles.csv,
  /// starts.csv, posterior.csv, next_experiment.csv; tables without rows are left out.
  void write_calibration_files(const std::filesystem::path &folder, const CalibrationResult &result,
                               const Scene &fitted);
} // namespace swimtwin
