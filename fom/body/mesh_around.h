// Meshes of the fluid around a swimmer.
#pragma once

#include <datasets/system/error.h>
#include <fom/body/swimmer.h>
#include <fom/mesh/fluid_mesh.h>

namespace swimtwin
{
  /// Whether a mesh failed for the shape of the fluid just there: an element inside out, or walls that cut the body's
  /// triangles. A moment before or later there may be one.
  bool failed_for_the_place(const ComputationError &error);

  /// Mesh the fluid around a configuration; where half of the scene is solved, and in space at rest, the upper half,
  /// reflected. Collective. At rest, the scene's settings are to blame for a mesh that fails: throws InputError that
  /// names the mesh size that does it. Else throws ComputationError.
  template <int dim>
  FluidMesh<dim> mesh_around(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                             MPI_Comm communicator);

  /// The same for bodies that move as they are told: whole in 2D, in space by halves where half of the scene is solved.
  template <int dim>
  FluidMesh<dim> mesh_for_given_motions(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                        MPI_Comm communicator);
} // namespace swimtwin
