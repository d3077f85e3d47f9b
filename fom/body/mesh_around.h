// Meshes of the fluid around a swimmer.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/mesh/fluid_mesh.h>

namespace swimtwin
{
  /// Mesh the fluid around a configuration; where half of the scene is solved, and in space at rest, the upper half,
  /// reflected. Collective. At rest, the scene's settings are to blame for a mesh that fails: throws InputError that
  /// names the mesh size that does it. Else throws ComputationError, InvertedElement if an element is inside out.
  template <int dim>
  FluidMesh<dim> mesh_around(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                             MPI_Comm communicator);

  /// The same for bodies that move as they are told: whole in 2D, in space by halves where half of the scene is solved.
  template <int dim>
  FluidMesh<dim> mesh_for_given_motions(const Swimmer<dim> &swimmer, const Configuration<dim> &configuration,
                                        MPI_Comm communicator);
} // namespace swimtwin
