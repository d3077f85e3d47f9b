// A periodic field that is played larger or smaller, faster or slower.
#pragma once

#include <rom/swimmer/driving_field.h>

namespace swimtwin
{
  /// Of a carrier.
  struct FieldChange
  {
    double bx_times = 1., by_times = 1., frequency_times = 1.;
  };

  /// Parameters whose names begin with bx and by are multiplied.
  Drive changed(const Drive &drive, const FieldChange &change);
  /// Its field turned by an angle; parameters as before.
  Drive turned(const Drive &drive, double angle_rad);
} // namespace swimtwin
