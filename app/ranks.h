// The processes that work together: several under MPI, one in the online build.
#pragma once

#include <functional>

namespace swimtwin
{
  /// Whether this process prints: rank 0.
  bool is_speaker();

  /// Wait, on all ranks but 0: most errors are noticed by all, and rank 0 speaks for them.
  void let_speaker_go_first();

  /// Do something on rank 0, with all ranks waiting; an InputError there is thrown by all.
  void agree(const std::function<void()> &on_speaker);

  /// End the others, which may wait for this rank for ever; returns if there are none.
  void end_all_ranks(int exit_code);
} // namespace swimtwin
