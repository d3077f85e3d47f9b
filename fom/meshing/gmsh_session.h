// gmsh as a global machine, started at the first mesh; what it makes on one rank, all ranks get.
#pragma once

#include <datasets/system/error.h>
#include <fom/geometry/simplex_mesh.h>

#include <functional>
#include <string>

namespace swimtwin
{
  /// Call before anything of gmsh, on the rank that meshes: starts it with this project's settings if need be, empties
  /// it, and makes what is random in it repeatable.
  void begin_gmsh_model();

  /// Largest distance (m) from the first of some points: gmsh's tolerances are absolute, so it sees a region in units
  /// of its own extent.
  template <int dim>
  double extent(const std::vector<dealii::Point<dim>> &points)
  {
    double largest = 0.;
    for (const auto &x : points)
      largest = std::max(largest, x.distance(points.front()));
    return largest;
  }

  /// Flat triangles that bound a region go through each other; what() says why, without a remedy.
  class CrossedSurfaces : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };

  /// Run a mesh generator on rank 0 and give its mesh to all. Collective; throws ComputationError with what gmsh said
  /// if it fails or there is not one cell, of these CrossedSurfaces and OutOfMemory.
  template <int dim>
  SimplexSoup<dim> mesh_on_first_rank(const std::function<SimplexSoup<dim>()> &generate, MPI_Comm communicator);
} // namespace swimtwin
