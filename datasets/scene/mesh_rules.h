// The rules of a mesh before there is one: its sizes, and how large it would be. Each throws InputError as those of
// datasets/scene/scene_rules.h do.
#pragma once

#include <datasets/scene/scene.h>

namespace swimtwin
{
  class TomlDocument;

  /// About how many cells the fluid's mesh would have, in a narrow gap no more than elsewhere; 0 without a domain.
  double expected_cells(const Scene &scene);

  /// The same of the swimmer's body: tetrahedra of its tail and triangles of its head; in the plane triangles of the
  /// tail.
  double expected_body_cells(const Scene &scene);

  /// Of a complete scene.
  void check_mesh(const TomlDocument &document, const Scene &scene);
} // namespace swimtwin
