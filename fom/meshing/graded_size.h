// Mesh sizes in space that grow away from where they are prescribed.
#pragma once

#include <fom/meshing/tetrahedralize.h>

namespace swimtwin
{
  /// The size at the nearest of the prescribed points plus `growth` times the distance to it, at most `largest` (m).
  /// Sizes at neighbouring points must not differ by more than that growth.
  SpatialSizeField graded_size(const std::vector<std::pair<dealii::Point<3>, double>> &prescribed, double growth,
                               double largest);

  /// The same times a factor.
  SpatialSizeField scaled(const SpatialSizeField &size, double factor);
} // namespace swimtwin
