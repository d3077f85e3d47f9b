// The rules that tie entries of a scene together. Each throws InputError with place, entry, value, rule and remedy.
#pragma once

#include <datasets/scene/scene.h>

namespace swimtwin
{
  class TomlDocument;

  void check_dimension(const TomlDocument &document, int dimension);
  /// Head and domain have the lengths that their shapes need, and no others.
  void check_shape_entries(const TomlDocument &document, const Scene &scene);
  /// Given motions stand where they are asked for, and nowhere else.
  void check_motion_entries(const TomlDocument &document, const Scene &scene);
  /// The entries of [field] belong to its waveform.
  void check_field_entries(const TomlDocument &document);
  /// [time] counts periods when the field, or a prescribed motion, has one, and seconds when it has none.
  void check_time_entries(const TomlDocument &document, bool is_periodic, bool is_steady);
  /// Every rule on the complete scene: physics, walls, geometry, time steps, mesh sizes.
  void check_scene(const TomlDocument &document, const Scene &scene);
} // namespace swimtwin
