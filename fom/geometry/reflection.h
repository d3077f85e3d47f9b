// Reflection of points and meshes at a line y = const.
#pragma once

#include <fom/geometry/simplex_mesh.h>

namespace swimtwin
{
  /// A mesh and its reflection at y = plane_y, glued along the vertices on the plane (exactly there). They keep their
  /// numbers; the others' images follow. `image` receives the image of every vertex of the result.
  SimplexSoup<2> reflect(const SimplexSoup<2> &upper, double plane_y, std::vector<unsigned int> &image);

  /// Reflection at y = plane_y; what is above 0 keeps its digits at plane_y = 0.
  inline dealii::Point<2> mirrored(const dealii::Point<2> &x, const double plane_y = 0.)
  {
    return {x[0], 2. * plane_y - x[1]};
  }
} // namespace swimtwin
