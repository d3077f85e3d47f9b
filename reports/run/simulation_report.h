// What the tool says after a run.
#pragma once

#include <datasets/run/trajectory.h>
#include <datasets/scene/scene.h>

#include <string>

namespace swimtwin
{
  /// A few lines: displacement per period, power balance, effort.
  std::string describe(const Scene &scene, const RunSummary &summary);
} // namespace swimtwin
