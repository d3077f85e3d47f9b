// Goals of the kinds "path" and "closed-loop": swim along a path, with files and pictures.
#pragma once

#include <app/frame/verb.h>
#include <app/trust/carried_inertia.h>
#include <app/trust/refinement.h>

namespace swimtwin
{
  struct TrackCommand
  {
    CommonOptions common;
    std::string   model, goal;
    RefineOptions refine;
    InertiaChoice inertia;
    bool          with_replay         = false; ///< play the plan of a path blindly on the full-order model too
    bool          no_picture          = false;
    bool          accepts_model_error = false; ///< above what a result may rest on

    bool has_replay() const { return with_replay || refine.is_asked_for(); }
    /// The option that asks for the full-order model.
    const char *reason_for_replay() const { return with_replay ? "--replay" : "--refine"; }
  };

  /// Throws InputError and ComputationError.
  void track_and_report(const TrackCommand &command);
} // namespace swimtwin
