// Bodies that are read from a surface: its triangles are the mesh of their surface, and of their tail's.
#include <datasets/surface/elastic_part.h>
#include <fom/mesh/inverted_element.h>
#include <fom/meshing/graded_size.h>
#include <fom/space/body_surface.h>
#include <fom/space/untangling.h>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    Point<3> node_of(const ClosedSurface &surface, const unsigned int node)
    {
      const auto &x = surface.nodes[node];
      return {x[0], x[1], x[2]};
    }

    void add_face(QuadraticSurface &surface, const ClosedSurface &body, const SurfaceFace &face, const int patch)
    {
      std::array<Point<3>, 3> vertices, middles;
      for (int v = 0; v < 3; ++v)
      {
        vertices[v] = node_of(body, face[v]);
        middles[v]  = node_of(body, face[3 + v]);
      }
      surface.add(vertices, middles, patch);
    }

    /// The tail's part of the body's surface, and its root in the plane of the rim.
    QuadraticSurface surface_of_tail(const ClosedSurface &body, const ElasticPart &part, const MPI_Comm communicator)
    {
      QuadraticSurface surface;
      for (std::size_t f = 0; f < body.faces.size(); ++f)
        if (part.has_face[f])
          add_face(surface, body, body.faces[f], first_side_patch);
      std::vector<Point<3>> rim;
      double                length = 0.;
      for (std::size_t i = 0; i < part.rim.size(); ++i)
      {
        rim.push_back(node_of(body, part.rim[i]));
        if (i % 2 == 0)
          length += rim.back().distance(node_of(body, part.rim[(i + 2) % part.rim.size()]));
      }
      const double edge = 2. * length / static_cast<double>(rim.size());
      auto         root = plane_patch({rim}, 0, [edge](const Point<3> &) { return edge; });
      root.number       = root_patch;
      add_patch(surface, root, communicator);
      return surface;
    }

    /// From the edges of the surface inwards.
    SpatialSizeField size_inside(const QuadraticSurface &surface, const Numerics &numerics)
    {
      std::vector<std::pair<double, int>> edges(surface.corners.vertices.size()); // sum of lengths, and their number
      for (const auto &[edge, middle] : surface.middle)
        for (const auto vertex : edge)
        {
          edges[vertex].first += surface.corners.vertices[edge[0]].distance(surface.corners.vertices[edge[1]]);
          ++edges[vertex].second;
        }
      std::vector<std::pair<Point<3>, double>> prescribed;
      for (unsigned int v = 0; v < edges.size(); ++v)
        prescribed.emplace_back(surface.corners.vertices[v], edges[v].first / edges[v].second);
      return graded_size(prescribed, .5, 3. * numerics.mesh_size_m);
    }

    /// The edge that ends at the vertex farthest along x and comes from as straight before as any.
    std::array<unsigned int, 3> edge_at_tip(const SimplexMesh<3> &mesh)
    {
      unsigned int tip = 0;
      for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.nodes[v][0] > mesh.nodes[tip][0])
          tip = v;
      unsigned int before = tip;
      double       most   = 0.;
      for (const auto &edge : mesh.edges())
        if (edge[0] == tip || edge[1] == tip)
        {
          const unsigned int other = edge[0] == tip ? edge[1] : edge[0];
          const Tensor<1, 3> along = mesh.nodes[tip] - mesh.nodes[other];
          if (along[0] / along.norm() > most)
          {
            most   = along[0] / along.norm();
            before = other;
          }
        }
      return {before, mesh.edge_node(before, tip), tip};
    }

    std::unique_ptr<TailMesh<3>> make_tail(const QuadraticSurface &surface, const Numerics &numerics,
                                           const MPI_Comm communicator)
    {
      const auto soup = tetrahedralize(surface.corners, size_inside(surface, numerics), communicator);
      auto       tail = std::make_unique<TailMesh<3>>(TailMesh<3>{SimplexMesh<3>(soup, communicator), {}, {}, {}, {}});
      SimplexMesh<3> &mesh = tail->mesh;
      if (numerics.tail_order == 2)
      {
        for (const auto &[edge, middle] : surface.middle)
          mesh.nodes[mesh.edge_node(edge[0], edge[1])] = middle;
        untangle(mesh, surface);
      }
      refuse_inverted_elements(mesh, "the tail's mesh (origin at the head's centre)");
      std::vector<char> is_clamped(mesh.n_nodes(), 0);
      for (unsigned int t = 0; t < surface.corners.triangles.size(); ++t)
        for (int v = 0; surface.patch_of[t] == root_patch && v < 3; ++v)
        {
          const unsigned int a = surface.corners.triangles[t][v], b = surface.corners.triangles[t][(v + 1) % 3];
          is_clamped[a] = is_clamped[mesh.edge_node(a, b)] = 1;
        }
      for (unsigned int node = 0; node < is_clamped.size(); ++node)
        if (is_clamped[node])
          tail->clamped_nodes.push_back(node);
      tail->axis_at_tip = edge_at_tip(mesh);
      return tail;
    }
  } // namespace

  BodyMesh<3> body_of_surface(const Scene &scene, const MPI_Comm communicator)
  {
    const ClosedSurface &surface = *scene.head.surface;
    BodyMesh<3>          body;
    for (unsigned int node = 0; node < surface.nodes.size(); ++node)
      body.surface.nodes.push_back(node_of(surface, node));
    body.surface.faces.assign(surface.faces.begin(), surface.faces.end());
    body.tail_node.assign(surface.nodes.size(), -1);
    set_vertices_and_sizes(body);
    if (!scene.tail)
      return body;

    const ElasticPart     &part  = *scene.tail->part;
    const QuadraticSurface sides = surface_of_tail(surface, part, communicator);
    body.tail                    = make_tail(sides, scene.numerics, communicator);
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
      for (int v = 0; part.has_face[f] && v < 3; ++v)
      {
        const SurfaceFace &face     = surface.faces[f];
        const unsigned int a        = sides.existing_number_at(node_of(surface, face[v])),
                           b        = sides.existing_number_at(node_of(surface, face[(v + 1) % 3]));
        body.tail_node[face[v]]     = static_cast<int>(a);
        body.tail_node[face[3 + v]] = static_cast<int>(body.tail->mesh.edge_node(a, b));
      }
    if (scene.numerics.tail_order == 1)
      straighten(body);
    return body;
  }
} // namespace swimtwin
