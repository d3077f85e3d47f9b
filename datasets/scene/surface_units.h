// Surfaces in another unit of length than the scene says.
#pragma once

#include <datasets/scene/scene.h>

namespace swimtwin
{
  class TomlDocument;

  /// A domain that is shorter than the swimmer, or more than 300 times as long, where another usual unit of the surface
  /// that is read would make them go together, is taken for a mistake. Throws InputError that names that unit.
  void check_surface_units(const TomlDocument &document, const Scene &scene);
} // namespace swimtwin
