// One run of the full-order model with its report: shared by the verbs simulate and demo.
#pragma once

#include <app/frame/verb.h>

namespace swimtwin
{
  struct SimulateOptions
  {
    bool resume = false, pictures = false;
  };

  /// Collective. Throws InputError and ComputationError.
  void simulate_and_report(const Scene &scene, const CommonOptions &common, const SimulateOptions &own);
} // namespace swimtwin
