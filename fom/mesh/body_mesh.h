// The body at rest, meshed once: its surface, its tail, and which of their nodes are the same.
#pragma once

#include <fom/mesh/tail_mesh.h>
#include <fom/surface/surface_mesh.h>

#include <memory>

namespace swimtwin
{
  template <int dim>
  struct BodyMesh
  {
    SurfaceMesh<dim>               surface;      ///< head frame
    std::vector<int>               tail_node;    ///< of every surface node: the tail's there, or -1 on the bare head
    std::vector<double>            surface_size; ///< m: of the mesh at the surface's vertices, which come in `vertices`
    std::vector<unsigned int>      vertices;     ///< surface nodes that are vertices
    std::unique_ptr<TailMesh<dim>> tail;         ///< none without a tail

    // Of a body in space that is its own mirror image at z = 0; else empty.
    std::vector<unsigned int> image;      ///< of every surface node
    std::vector<unsigned int> plane_loop; ///< surface nodes on the plane, a closed quadratic loop: vertex, middle, ...
  };

  /// A linear tail has straight edges, and the body's surface is its.
  template <int dim>
  void straighten(BodyMesh<dim> &body)
  {
    for (unsigned int k = 0; k < body.surface.nodes.size(); ++k)
      if (body.tail_node[k] >= 0)
        body.surface.nodes[k] = body.tail->mesh.nodes[body.tail_node[k]];
  }

  /// Collective; throws ComputationError, InvertedElement if an element of the tail is inside out.
  template <int dim>
  BodyMesh<dim> make_body_mesh(const Scene &scene, MPI_Comm communicator);

  template <>
  BodyMesh<2> make_body_mesh<2>(const Scene &scene, MPI_Comm communicator);
  template <>
  BodyMesh<3> make_body_mesh<3>(const Scene &scene, MPI_Comm communicator);
} // namespace swimtwin
