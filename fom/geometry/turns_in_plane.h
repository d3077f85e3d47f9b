// How far a mesh has turned at its nodes.
#pragma once

#include <fom/geometry/simplex_mesh.h>

namespace swimtwin
{
  /// Rotation about z (rad) of the surroundings of each node on the way from the mesh's own positions to these: the
  /// mean over its cells, each of which is taken as straight. In space what turns about other axes does not count.
  template <int dim>
  std::vector<double> turns_in_plane(const SimplexMesh<dim> &mesh, const std::vector<dealii::Point<dim>> &positions);
} // namespace swimtwin
