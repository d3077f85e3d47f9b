// Swimmers in hard conditions, and what a run may miss of its power balance there (docs/stress.md).
#pragma once

#include <tests/pipeline/simulation.h>

namespace swimtwin
{
  /// Second order in the step, 0.5 % at 100 steps per period; at least 0.1 %, at most 5 %.
  double balance_bound(int steps_per_period);

  /// One period of the coarse swimmer, 40 steps, with these entries in addition.
  ShrunkScene hard_swimmer(const std::vector<std::string> &settings, int steps_per_period = 40, double periods = 1.);

  /// Simulate; the test fails unless the run completes without a warning and every period's balance is within the
  /// bound.
  Motion expect_convergence(const ShrunkScene &scene, int steps_per_period = 40);

  /// The coarse swimmer in a field of 7 mT that turns once per period, 80 steps. Files go into the folder.
  ShrunkScene swimmer_in_turning_field(const TemporaryFolder &folder, double period_s,
                                       const std::vector<std::string> &settings);
} // namespace swimtwin
