// Whether a model was trained for a run: the ratios that a motion without inertia depends on.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <rom/integration/swimmer_run.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Why no trained run moves alike, one phrase each, empty if one does: the ratios that are outside, then the
  /// parameters that are outside by themselves. Without inertia a motion depends on ratios alone (docs/equations.md,
  /// section 16): a run is inside the range if a trained one has the same E/(mu f), M B/(mu f) and direction of the
  /// field, whatever E, mu, M, f and B are one by one. The field is compared for the reference sinusoid only, that of
  /// others counts as trained; a magnetised tail was trained at its own magnetization, so that the head's must lie in
  /// its range, too. A range of zero width counts as the value to seven digits.
  std::vector<std::string> notes_outside_range(const TrainedRange &range, const RunRequest &request);

  /// Each parameter that is outside its own range, one phrase each: "young_modulus_Pa = 5e+05 above 3e+05".
  std::vector<std::string> parameters_outside_range(const TrainedRange &range, const RunRequest &request);
} // namespace swimtwin
