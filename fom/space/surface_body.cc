// Bodies that are read from a surface: its triangles are the mesh of their surface.
#include <datasets/surface/closed_surface.h>
#include <fom/space/body_surface.h>

namespace swimtwin
{
  using namespace dealii;

  BodyMesh<3> body_of_surface(const ClosedSurface &surface)
  {
    BodyMesh<3> body;
    for (const auto &x : surface.nodes)
      body.surface.nodes.emplace_back(x[0], x[1], x[2]);
    body.surface.faces.assign(surface.faces.begin(), surface.faces.end());
    body.tail_node.assign(surface.nodes.size(), -1);
    set_vertices_and_sizes(body);
    return body;
  }
} // namespace swimtwin
