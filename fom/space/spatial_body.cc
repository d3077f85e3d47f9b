// Bodies in space, meshed at z >= 0 and reflected.
#include <fom/geometry/reflection.h>
#include <fom/mesh/body_mesh.h>
#include <fom/mesh/inverted_element.h>
#include <fom/meshing/graded_size.h>
#include <fom/space/body_surface.h>
#include <fom/space/untangling.h>

#include <deque>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Turn triangles until neighbours agree on what is outside.
    void orient_alike(TriangleSurface &surface)
    {
      std::map<Edge, std::vector<unsigned int>> triangles_at;
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        for (int v = 0; v < 3; ++v)
          triangles_at[edge_between(surface.triangles[t][v], surface.triangles[t][(v + 1) % 3])].push_back(t);
      const auto runs = [&](const unsigned int t, const unsigned int a, const unsigned int b) {
        const auto &c = surface.triangles[t];
        return (c[0] == a && c[1] == b) || (c[1] == a && c[2] == b) || (c[2] == a && c[0] == b);
      };
      std::vector<char>        done(surface.triangles.size(), 0);
      std::deque<unsigned int> next{0};
      done[0] = 1;
      while (!next.empty())
      {
        const unsigned int t = next.front();
        next.pop_front();
        for (int v = 0; v < 3; ++v)
        {
          const unsigned int a = surface.triangles[t][v], b = surface.triangles[t][(v + 1) % 3];
          for (const unsigned int other : triangles_at[edge_between(a, b)])
            if (!done[other])
            {
              if (runs(other, a, b))
                std::swap(surface.triangles[other][1], surface.triangles[other][2]);
              done[other] = 1;
              next.push_back(other);
            }
        }
      }
    }

    SpatialSizeField interior_size(const QuadraticSurface &surface, const SpatialSizeField &size,
                                   const Numerics &numerics)
    {
      std::vector<std::pair<Point<3>, double>> prescribed;
      for (const auto &x : surface.corners.vertices)
        prescribed.emplace_back(x, size(x));
      return graded_size(prescribed, .5, 3. * numerics.mesh_size_m);
    }

    std::unique_ptr<TailMesh<3>> make_tail(const TailSurface &tail, const SpatialSizeField &size,
                                           const Numerics &numerics, const MPI_Comm communicator)
    {
      std::vector<unsigned int> image;
      const auto                soup = reflect(
                         tetrahedralize(tail.surface.corners, interior_size(tail.surface, size, numerics), communicator), 0., image);
      auto mesh = std::make_unique<TailMesh<3>>(TailMesh<3>{SimplexMesh<3>(soup, communicator), {}, {}, {}, image});
      curve_edges(mesh->mesh, tail.surface, image);
      if (numerics.tail_order == 1)
        straighten(mesh->mesh);
      else
        untangle(mesh->mesh, tail.surface, image, plane_patch_number, tail.axis);
      refuse_inverted_elements(mesh->mesh, "the tail's mesh (origin at the head's centre)");

      std::vector<char> is_clamped(mesh->mesh.n_nodes(), 0);
      for (unsigned int t = 0; t < tail.surface.corners.triangles.size(); ++t)
        if (tail.surface.patch_of[t] < first_side_patch)
          for (int v = 0; v < 3; ++v)
          {
            const unsigned int a = tail.surface.corners.triangles[t][v],
                               b = tail.surface.corners.triangles[t][(v + 1) % 3];
            for (const unsigned int node :
                 {a, image[a], mesh->mesh.edge_node(a, b), mesh->mesh.edge_node(image[a], image[b])})
              is_clamped[node] = 1;
          }
      for (unsigned int node = 0; node < is_clamped.size(); ++node)
        if (is_clamped[node])
          mesh->clamped_nodes.push_back(node);
      const unsigned int tip    = tail.surface.existing_number_at(tail.axis.back()),
                         before = tail.surface.existing_number_at(tail.axis[tail.axis.size() - 3]);
      mesh->axis_at_tip         = {before, mesh->mesh.edge_node(before, tip), tip};
      return mesh;
    }

    /// The body's half surface: the head's, and the tail's side as the tail has it.
    QuadraticSurface join(QuadraticSurface head, const std::optional<TailSurface> &tail)
    {
      if (tail)
        for (unsigned int t = 0; t < tail->surface.corners.triangles.size(); ++t)
          if (const int patch = tail->surface.patch_of[t]; patch >= first_side_patch && patch < plane_patch_number)
          {
            std::array<Point<3>, 3> vertices, middles;
            const auto             &corners = tail->surface.corners.triangles[t];
            for (int v = 0; v < 3; ++v)
            {
              vertices[v] = tail->surface.corners.vertices[corners[v]];
              middles[v]  = tail->surface.middle.at(edge_between(corners[v], corners[(v + 1) % 3]));
            }
            head.add(vertices, middles, patch);
          }
      orient_alike(head.corners);
      return head;
    }

    /// Nodes and faces of the whole surface from those of its half: vertices, middles, then images of both.
    class WholeSurface
    {
    public:
      WholeSurface(const QuadraticSurface &half, BodyMesh<3> &body) : half_(half), body_(body)
      {
        body_.surface.nodes = half.corners.vertices;
        for (const auto &[edge, x] : half.middle)
        {
          middle_[edge] = body_.surface.nodes.size();
          body_.surface.nodes.push_back(x);
        }
        const unsigned int n = body_.surface.nodes.size();
        for (unsigned int k = 0; k < n; ++k)
          body_.image.push_back(body_.surface.nodes[k][2] == 0. ? k : add_image(k));
        body_.image.resize(body_.surface.nodes.size());
        for (unsigned int k = 0; k < n; ++k)
          body_.image[body_.image[k]] = k;
        for (const auto &corners : half.corners.triangles)
          add_face(corners);
        turn_outwards();
      }

      unsigned int vertex_at(const Point<3> &x) const { return half_.existing_number_at(x); }
      unsigned int middle(const unsigned int a, const unsigned int b) const { return middle_.at(edge_between(a, b)); }

      void set_loop(const MeridianTrace &trace)
      {
        std::vector<unsigned int> vertices; // in a closed loop
        for (unsigned int i = 0; i < trace.above.size(); i += 2)
          vertices.push_back(vertex_at(trace.above[i]));
        for (unsigned int i = trace.below.size() - 3; i > 0; i -= 2)
          vertices.push_back(vertex_at(trace.below[i]));
        for (unsigned int i = 0; i < vertices.size(); ++i)
        {
          body_.plane_loop.push_back(vertices[i]);
          body_.plane_loop.push_back(middle(vertices[i], vertices[(i + 1) % vertices.size()]));
        }
      }

      void set_tail_nodes(const TailSurface &tail)
      {
        body_.tail_node.assign(body_.surface.nodes.size(), -1);
        const auto &mesh  = body_.tail->mesh;
        const auto &image = body_.tail->image_of_vertex;
        const auto  there = [&](const unsigned int a) {
          return tail.surface.existing_number_at(body_.surface.nodes[a]);
        };
        const auto set = [&](const unsigned int node, const unsigned int tail_node, const unsigned int tail_image) {
          body_.tail_node[body_.image[node]] = tail_image;
          body_.tail_node[node]              = tail_node;
        };
        for (unsigned int t = 0; t < half_.corners.triangles.size(); ++t)
          if (half_.patch_of[t] >= first_side_patch)
            for (int v = 0; v < 3; ++v)
            {
              const unsigned int a = half_.corners.triangles[t][v], b = half_.corners.triangles[t][(v + 1) % 3];
              set(a, there(a), image[there(a)]);
              set(middle(a, b), mesh.edge_node(there(a), there(b)), mesh.edge_node(image[there(a)], image[there(b)]));
            }
      }

    private:
      unsigned int add_image(const unsigned int k)
      {
        body_.surface.nodes.push_back(mirrored(body_.surface.nodes[k]));
        return body_.surface.nodes.size() - 1;
      }
      void add_face(const std::array<unsigned int, 3> &corners)
      {
        const auto &[a, b, c] = corners;
        const FaceNodes<3> face{a, b, c, middle(a, b), middle(b, c), middle(c, a)};
        FaceNodes<3>       image{a, c, b, middle(c, a), middle(b, c), middle(a, b)};
        for (auto &node : image)
          node = body_.image[node];
        body_.surface.faces.push_back(face);
        body_.surface.faces.push_back(image);
      }
      void turn_outwards()
      {
        const std::vector<Tensor<1, 3>> x(body_.surface.nodes.begin(), body_.surface.nodes.end());
        if (enclosed_volume<3>(body_.surface.faces, x) < 0.)
          for (auto &face : body_.surface.faces)
          {
            std::swap(face[1], face[2]);
            std::swap(face[3], face[5]);
          }
      }

      const QuadraticSurface      &half_;
      BodyMesh<3>                 &body_;
      std::map<Edge, unsigned int> middle_;
    };

    BodyMesh<3> body_of_shapes(const Scene &scene, const MPI_Comm communicator)
    {
      const bool        is_film = scene.tail && scene.tail->section == TailSection::rectangular;
      const BodySurface surface = is_film ? film_body(scene, communicator) : revolved_body(scene, communicator);
      BodyMesh<3>       body;
      if (surface.tail)
        body.tail = make_tail(*surface.tail, surface.size, scene.numerics, communicator);
      const QuadraticSurface half = join(surface.head, surface.tail);
      WholeSurface           whole(half, body);
      whole.set_loop(surface.trace);
      set_vertices_and_sizes(body);
      if (surface.tail)
        whole.set_tail_nodes(*surface.tail);
      else
        body.tail_node.assign(body.surface.nodes.size(), -1);
      if (surface.tail && scene.numerics.tail_order == 1)
        straighten(body);
      return body;
    }
  } // namespace

  void set_vertices_and_sizes(BodyMesh<3> &body)
  {
    std::vector<double> sum(body.surface.nodes.size(), 0.);
    std::vector<int>    n(sum.size(), 0);
    for (const auto &face : body.surface.faces)
      for (int v = 0; v < 3; ++v)
      {
        const unsigned int a = face[v], b = face[(v + 1) % 3];
        const double       length = body.surface.nodes[a].distance(body.surface.nodes[b]);
        sum[a] += length;
        sum[b] += length;
        ++n[a];
        ++n[b];
      }
    for (unsigned int k = 0; k < sum.size(); ++k)
      if (n[k] > 0)
      {
        body.vertices.push_back(k);
        body.surface_size.push_back(sum[k] / n[k]);
      }
  }

  template <>
  BodyMesh<3> make_body_mesh<3>(const Scene &scene, const MPI_Comm communicator)
  {
    if (scene.head.surface)
      return body_of_surface(scene, communicator);
    return first_not_inverted([&](const double factor) {
      Scene finer = scene;
      finer.numerics.mesh_size_m *= factor;
      finer.numerics.mesh_size_corner_m *= factor;
      return body_of_shapes(finer, communicator);
    });
  }
} // namespace swimtwin
