#include <fom/mesh/body_mesh.h>

#include <fom/mesh/swimmer_outline.h>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Faces of a closed quadratic loop: vertex, middle, vertex, ...
    std::vector<FaceNodes<2>> faces_of_loop(const unsigned int n)
    {
      std::vector<FaceNodes<2>> faces;
      for (unsigned int p = 0; p < n; p += 2)
        faces.push_back({p, p + 1, (p + 2) % n});
      return faces;
    }

    /// Mean length of the edges at every second node.
    std::vector<double> edge_lengths(const std::vector<Point<2>> &loop)
    {
      const unsigned int  n = loop.size();
      std::vector<double> size;
      for (unsigned int k = 0; k < n; k += 2)
        size.push_back(.5 * (loop[k].distance(loop[(k + 2) % n]) + loop[k].distance(loop[(k + n - 2) % n])));
      return size;
    }
  } // namespace

  template <>
  BodyMesh<2> make_body_mesh<2>(const Scene &scene, const MPI_Comm communicator)
  {
    const SwimmerOutline outline = make_outline(scene.head, scene.tail, scene.numerics);
    BodyMesh<2>          body;
    body.surface.nodes = outline.surface();
    body.surface.faces = faces_of_loop(body.surface.nodes.size());
    body.surface_size  = edge_lengths(body.surface.nodes);
    for (unsigned int k = 0; k < body.surface.nodes.size(); k += 2)
      body.vertices.push_back(k);
    body.tail_node.assign(body.surface.nodes.size(), -1);
    if (!scene.tail)
      return body;
    body.tail                = std::make_unique<TailMesh<2>>(make_tail_mesh(outline, scene.numerics, communicator));
    const unsigned int first = outline.upper_head.size() - 1;
    for (unsigned int i = 0; i < body.tail->surface_nodes.size(); ++i)
      body.tail_node[first + i] = body.tail->surface_nodes[i];
    if (scene.numerics.tail_order == 1)
      straighten(body);
    return body;
  }
} // namespace swimtwin
