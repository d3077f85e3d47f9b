// The page of a fit.
#pragma once

#include <datasets/observation/calibration_result.h>
#include <reports/page/html_page.h>
#include <reports/run/run_report.h>

#include <filesystem>
#include <string>

namespace swimtwin
{
  /// Whether `calibrate` left its result there.
  bool is_calibration(const std::filesystem::path &folder);

  /// Verdict, parameters with intervals, what the data cannot tell, pictures, observations, the model's own error, the
  /// next experiment, the search, provenance, problem.
  HtmlPage calibration_page(const CalibrationResult &result, const std::string &name,
                            const Illustrations &illustrations);
} // namespace swimtwin
