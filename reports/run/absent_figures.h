// Words for the figures of a run that were not computed, so that nothing stands where a number would claim too much.
#pragma once

#include <datasets/run/trajectory.h>

#include <optional>
#include <string>

namespace swimtwin
{
  bool has_full_period(const RunSummary &summary);

  /// Why the summary has no power imbalance: "no full period was computed", ...
  std::string why_no_imbalance(const RunSummary &summary);

  /// An imbalance in per cent with its sign, or why there is none.
  std::string imbalance_text(const std::optional<double> &imbalance, const RunSummary &summary, int n_digits);
} // namespace swimtwin
