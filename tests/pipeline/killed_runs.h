// Runs that are killed at random instants, and what a kill may leave.
#pragma once

#include <tests/pipeline/simulation.h>

#include <random>
#include <string>

namespace swimtwin
{
  /// What a process has come to when it is killed.
  enum class KillInstant {
    any_time,      ///< from its start on
    while_writing, ///< a file has its temporary name
    results_named  ///< results are written, and take their final names
  };

  /// A run that writes all that a run can write, at every step: fields and snapshots; a checkpoint at every fourth.
  ShrunkScene busy_swimmer(const std::string &inertia);

  /// Kill a run `n_kills` times, each time at another instant, and resume it; when it comes to its end, start another.
  /// After each kill every file is whole or absent and no more than the steps since the last checkpoint are lost; each
  /// end is that of a run that was not interrupted. The instants follow from the seed and the machine's speed.
  void kill_and_resume(const ShrunkScene &scene, int n_kills, unsigned int seed);
} // namespace swimtwin
