// A plan from files to files, for the verbs that make one.
#pragma once

#include <app/frame/verb.h>
#include <app/full_order/field_replay.h>
#include <app/trust/carried_inertia.h>
#include <app/trust/refinement.h>

namespace swimtwin
{
  struct OptimizeCommand
  {
    CommonOptions common;
    std::string   model, goal, trade_off;
    ReplayOptions replay;
    RefineOptions refine;
    InertiaChoice inertia;
    int           n_threads   = 0;
    bool          with_replay = false, check_gradients = false, no_picture = false;
    bool          accepts_model_error = false; ///< above what a result may rest on

    bool has_replay() const { return with_replay || refine.is_asked_for(); }
  };

  /// Collective.
  void optimize_and_report(const OptimizeCommand &command);
} // namespace swimtwin
