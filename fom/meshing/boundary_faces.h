// Cells that stay sound when the edges on the boundary are curved.
#pragma once

#include <fom/meshing/tetrahedralize.h>

#include <set>

namespace swimtwin
{
  /// Where three edges of a cell run from a vertex along one smooth piece of the boundary, they are tangent to it when
  /// they are curved, and the map of the cell is singular at the vertex. Such a cell is divided, with a new vertex on
  /// one of its other edges that is pushed to where the cells around it have the best shapes. The boundary stays.
  void free_corners_from_boundary(SimplexSoup<3> &soup, const TriangleSurface &boundary);

  /// The same of triangles, where two boundary edges meet at nearly two right angles.
  void free_corners_from_boundary(SimplexSoup<2> &soup, const std::set<Edge> &boundary);
} // namespace swimtwin
