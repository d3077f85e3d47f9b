// What a run would take, for the verb plan.
#pragma once

#include <app/frame/verb.h>

namespace swimtwin
{
  /// Meshes, but solves nothing. Collective. Throws InputError and ComputationError.
  void plan_and_report(const Scene &scene, const CommonOptions &common);
} // namespace swimtwin
