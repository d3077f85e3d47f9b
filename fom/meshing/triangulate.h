// Triangle meshes of planar regions, made by gmsh.
#pragma once

#include <fom/geometry/planar_curve.h>
#include <fom/geometry/simplex_mesh.h>

namespace swimtwin
{
  /// A region bounded by closed polygons, given without repeating the first point.
  struct PlanarRegion
  {
    std::vector<dealii::Point<2>>              outer; ///< counter-clockwise
    std::vector<std::vector<dealii::Point<2>>> holes;
    SizeField size;           ///< wanted edge length (m) inside; the polygons are kept edge for edge
    bool      mirror = false; ///< give the reflection (at y = 0) of the mesh that the reflected region would get
  };

  /// The polygons' points come first and unchanged: outer, then each hole. Collective: rank 0 meshes and tells the
  /// others. The same region gives the same mesh. Throws ComputationError if gmsh cannot mesh the region.
  SimplexSoup<2> triangulate(const PlanarRegion &region, MPI_Comm communicator);
} // namespace swimtwin
