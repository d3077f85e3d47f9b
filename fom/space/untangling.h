// Elements that a curved surface folds, unfolded by moving what is free around them.
#pragma once

#include <fom/surface/surface_builder.h>

namespace swimtwin
{
  /// In a mesh whose half (z >= 0) has the vertices of `half` first, and of which `image` tells every vertex's
  /// reflection: move nodes beside the elements that are folded until there are none or nothing helps. Nodes on the
  /// surface stay, but for those of the patches `on_plane` (z = 0), which stay in the plane and off `kept`. The mesh
  /// remains its own mirror image.
  void untangle(SimplexMesh<3> &mesh, const QuadraticSurface &half, const std::vector<unsigned int> &image,
                int on_plane, const std::vector<dealii::Point<3>> &kept = {});

  /// The same of a mesh that is made as a whole, within a surface that stays.
  void untangle(SimplexMesh<3> &mesh, const QuadraticSurface &surface);
} // namespace swimtwin
