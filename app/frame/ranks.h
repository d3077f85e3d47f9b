// The processes that work together: several under MPI, one in the online build.
#pragma once

#include <functional>

namespace swimtwin
{
  /// Whether this process prints: rank 0.
  bool is_speaker();

  /// How the ranks end, once they have told each other.
  struct Ending
  {
    int  exit_code   = 0;     ///< the largest of all ranks
    bool all_came    = true;  ///< false: some rank does not know of the failure, and may wait for this one for ever
    bool is_to_speak = false; ///< the first rank that failed
  };

  /// Called by every rank at its end, whether it failed or not. A rank that failed waits two seconds for the others.
  Ending end_together(int own_exit_code);

  /// Do something on rank 0, with all ranks waiting; what it throws there is thrown by all, as InputError or as
  /// ComputationError. Collective.
  void agree(const std::function<void()> &on_speaker);

  /// Rank 0's value, for a decision that all must take alike. Collective.
  double of_speaker(double value);

  /// End the others, which may wait for this rank for ever; returns if there are none.
  void end_all_ranks(int exit_code);
} // namespace swimtwin
