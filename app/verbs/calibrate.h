// A fit from files to files, for the verbs that make one.
#pragma once

#include <app/frame/verb.h>
#include <app/trust/refinement.h>

namespace swimtwin
{
  struct CalibrateCommand
  {
    CommonOptions            common;
    std::string              model, problem;
    std::string              inertia; ///< "none", "auto", "full"; empty: as the scene has it
    std::vector<std::string> data;    ///< instead of those that the problem names
    int                      n_threads = 0, n_checks = 0;
    RefineOptions            refine;
    bool                     no_picture          = false;
    bool                     check_only          = false; ///< problem and data, without a fit; needs no folder
    bool                     accepts_model_error = false; ///< above what a result may rest on
  };

  void calibrate_and_report(const CalibrateCommand &command);
} // namespace swimtwin
