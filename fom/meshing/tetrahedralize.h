// Tetrahedron meshes of what a closed triangulated surface encloses, made by gmsh.
#pragma once

#include <fom/geometry/simplex_mesh.h>

#include <functional>
#include <limits>

namespace swimtwin
{
  /// Wanted edge length (m) at a point in space.
  using SpatialSizeField = std::function<double(const dealii::Point<3> &)>;

  struct TriangleSurface
  {
    std::vector<dealii::Point<3>>            vertices;
    std::vector<std::array<unsigned int, 3>> triangles; ///< all outwards, or all inwards
    /// From here on they bound holes, which are left empty; they share no vertex with those before.
    std::size_t first_of_hole = std::numeric_limits<std::size_t>::max();

    bool has_hole() const { return first_of_hole < triangles.size(); }
  };

  /// The surface is kept triangle for triangle, its vertices come first and unchanged. Collective: rank 0 meshes and
  /// tells the others. The same surface gives the same mesh. Throws ComputationError if gmsh cannot fill it.
  SimplexSoup<3> tetrahedralize(const TriangleSurface &surface, const SpatialSizeField &size, MPI_Comm communicator);
} // namespace swimtwin
