// Mesh sizes of the fluid around a body in space.
#pragma once

#include <datasets/scene/scene.h>
#include <fom/mesh/body_mesh.h>
#include <fom/meshing/tetrahedralize.h>

namespace swimtwin
{
  /// Those of the body's surface, whose nodes are at x, where it is, growing away from it.
  SpatialSizeField size_around(const BodyMesh<3> &body, const std::vector<dealii::Point<3>> &x,
                               const Numerics &numerics);
} // namespace swimtwin
