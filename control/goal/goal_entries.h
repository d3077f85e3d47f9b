// Entries that goals of several kinds share.
#pragma once

#include <control/field/field_limits.h>
#include <datasets/scene/scene.h>
#include <datasets/text/toml_table.h>
#include <rom/swimmer/driving_field.h>
#include <rom/swimmer/swimmer_parameters.h>

namespace swimtwin
{
  /// What the table leaves out keeps its value. Throws InputError.
  void read_swimmer(const TomlDocument &document, const std::string &name, SwimmerParameters &values);

  /// The sinusoid that is turned, [carrier]; the scene's own where entries are left out. `bound_T`, if not null,
  /// becomes the bound on |B|. Throws InputError for a carrier above it.
  Drive read_carrier(const TomlDocument &document, const Scene &scene, double *bound_T = nullptr);

  /// magnitude_T, bx_T, by_T, slew_rate_T_s, and coils: coil_1_A_T = [a, b], coil_2_A_T, ...: current = a bx + b by.
  void read_field_limits(TomlTable &table, FieldLimits &limits);

  /// [limits] of a carrier that is turned to every direction. Throws InputError for limits that it does not keep.
  FieldLimits read_limits_of_turned_field(const TomlDocument &document, const Drive &carrier);

  /// Whether the head stays clear of walls with its centre here (laboratory); so near, in m, it must not come.
  bool   head_is_inside(const Scene &scene, const Eigen::Vector2d &center_m);
  double head_margin_m(const Scene &scene);
} // namespace swimtwin
