// The rigid resistance matrix of a swimmer, for the verb resistance.
#pragma once

#include <app/frame/verb.h>

namespace swimtwin
{
  /// Of the swimmer at rest. The scene has a fluid. Collective. Throws InputError and ComputationError.
  void resistance_and_report(const Scene &scene, const CommonOptions &common);
} // namespace swimtwin
