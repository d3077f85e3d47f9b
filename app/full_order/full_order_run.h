// A run of the full-order model, in builds that have it.
#pragma once

#include <datasets/scene/scene.h>

#include <filesystem>

namespace swimtwin
{
  /// Displacement (m) of the head in the scene's last period, positive head first. The run's files go to `folder`.
  double full_order_displacement_m(const Scene &scene, const std::filesystem::path &folder);
} // namespace swimtwin
