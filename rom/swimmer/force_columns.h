// The order of RateDerivatives::columns.
#pragma once

namespace swimtwin
{
  /// After the angle and the shape.
  enum ForceColumn {
    by_young_modulus,
    by_magnetization,
    by_tail_magnetization,
    by_height,
    by_field_x,
    by_field_y,
    n_force_columns
  };
} // namespace swimtwin
