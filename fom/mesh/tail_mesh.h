// The tail's own mesh, Lagrangian for ever, in the head frame.
#pragma once

#include <fom/geometry/simplex_mesh.h>
#include <fom/mesh/swimmer_outline.h>

namespace swimtwin
{
  template <int dim>
  struct TailMesh
  {
    SimplexMesh<dim>          mesh;
    std::vector<unsigned int> clamped_nodes; ///< on the head, the root's two ends included
    std::vector<unsigned int>
        surface_nodes; ///< the part of SwimmerOutline::surface() that is the tail's, both root ends included
    std::array<unsigned int, 3> axis_at_tip;     ///< last edge on the axis: vertex, midpoint, tip
    std::vector<unsigned int>   image_of_vertex; ///< at y = 0
  };

  /// Mesh the upper half and reflect it, so that shapes have exact parity; edges are straight where displacements are
  /// linear. Collective; throws ComputationError, InvertedElement if an element is inside out.
  TailMesh<2> make_tail_mesh(const SwimmerOutline &outline, const Numerics &numerics, MPI_Comm communicator);
} // namespace swimtwin
