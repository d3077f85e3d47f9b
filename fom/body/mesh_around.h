// The fluid's mesh around a swimmer, in the way its scene is solved.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/mesh/fluid_mesh.h>

namespace swimtwin
{
  /// Mesh the fluid around the swimmer as it is: the whole of it, or its upper half and the reflection if half of the
  /// scene is solved. Collective; throws ComputationError.
  FluidMesh<2> mesh_around(const Swimmer<2> &swimmer, const Configuration<2> &configuration, MPI_Comm communicator);
} // namespace swimtwin
