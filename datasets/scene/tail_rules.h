// The rules of a tail: its section and profile, and how it leaves the head. Each throws InputError as those of
// datasets/scene/scene_rules.h do.
#pragma once

#include <datasets/scene/scene.h>

namespace swimtwin
{
  class TomlDocument;

  /// A scene with a tail: the entries go with its section and its profile.
  void check_tail_entries(const TomlDocument &document, const Scene &scene);
  /// A complete scene with a tail: it fits on the head, leaves it, and can be meshed there.
  void check_tail(const TomlDocument &document, const Scene &scene);
} // namespace swimtwin
