// The tables of a fit's page.
#pragma once

#include <datasets/observation/calibration_result.h>
#include <reports/page/html_page.h>

namespace swimtwin
{
  /// Fitted and derived parameters: estimate, standard error, intervals, bounds and prior.
  HtmlTable parameter_table(const CalibrationResult &result);
  /// The whole swimmer at the estimate.
  HtmlTable swimmer_table(const CalibratedSwimmer &swimmer);
  /// Correlations of the free parameters' scaled variables; empty when none is known.
  HtmlTable correlation_table(const CalibrationResult &result);
  HtmlTable observation_table(const CalibrationResult &result);
  /// Full-order runs at the optimum beside the reduced model.
  HtmlTable full_order_table(const ModelDiscrepancy &discrepancy);
  /// How the minimum was found.
  HtmlTable search_table(const CalibrationResult &result);
} // namespace swimtwin
