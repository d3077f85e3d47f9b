#include <fom/mesh/tail_mesh.h>

#include <fom/geometry/reflection.h>
#include <fom/mesh/inverted_element.h>
#include <fom/meshing/triangulate.h>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    using QuadraticCurve = std::vector<Point<2>>; // vertex, midpoint, vertex, ...

    /// Sizes inside: those of the boundary, growing inwards. Bending needs few quadratic elements across.
    SizeField interior_size(const SwimmerOutline &outline, const Numerics &numerics)
    {
      std::vector<std::pair<Point<2>, double>> prescribed;
      for (const auto *curve : {&outline.upper_side, &outline.upper_root})
        for (unsigned int i = 0; i < curve->size(); i += 2)
          prescribed.emplace_back((*curve)[i], outline.size((*curve)[i]));
      return graded_size(std::move(prescribed), 0.5, 3. * numerics.mesh_size_m);
    }

    void append_vertices(std::vector<Point<2>> &polygon, const QuadraticCurve &curve)
    {
      for (unsigned int i = 0; i + 1 < curve.size(); i += 2)
        polygon.push_back(curve[i]);
    }

    /// Put mid-edge nodes of a boundary curve in place; `vertices` are the mesh's vertices along it.
    void curve_edges(SimplexMesh<2> &mesh, const QuadraticCurve &curve, const std::vector<unsigned int> &vertices,
                     std::vector<unsigned int> &nodes)
    {
      nodes.push_back(vertices.front());
      for (unsigned int e = 0; e + 1 < vertices.size(); ++e)
      {
        nodes.push_back(mesh.edge_node(vertices[e], vertices[e + 1]));
        mesh.nodes[nodes.back()] = curve[2 * e + 1];
        nodes.push_back(vertices[e + 1]);
      }
    }

    QuadraticCurve mirrored_curve(QuadraticCurve curve)
    {
      for (auto &x : curve)
        x = mirrored(x);
      return curve;
    }

    std::vector<unsigned int> images(const std::vector<unsigned int> &vertices, const std::vector<unsigned int> &image)
    {
      std::vector<unsigned int> result;
      for (const auto v : vertices)
        result.push_back(image[v]);
      return result;
    }
  } // namespace

  TailMesh<2> make_tail_mesh(const SwimmerOutline &outline, const Numerics &numerics, const MPI_Comm communicator)
  {
    const SizeField size = interior_size(outline, numerics);
    QuadraticCurve  axis = divide(PlanarCurve::line(outline.upper_root.front(), outline.tip()), size);
    axis.back()          = outline.tip();
    const QuadraticCurve tip_to_root(outline.upper_side.rbegin(), outline.upper_side.rend());
    const QuadraticCurve root_to_axis(outline.upper_root.rbegin(), outline.upper_root.rend());

    PlanarRegion half;
    half.size = size;
    append_vertices(half.outer, axis);
    append_vertices(half.outer, tip_to_root);
    append_vertices(half.outer, root_to_axis);

    // Vertices along the three parts of the half's boundary, as they are numbered by triangulate().
    const unsigned int n_axis = axis.size() / 2 + 1, n_side = outline.upper_side.size() / 2 + 1,
                       n_root = outline.upper_root.size() / 2 + 1;
    std::vector<unsigned int> side, root{0};
    for (unsigned int i = 0; i < n_side; ++i)
      side.insert(side.begin(), n_axis - 1 + i); // root -> tip
    for (unsigned int i = 1; i < n_root; ++i)
      root.push_back(n_axis + n_side - 2 + (n_root - 1 - i)); // axis -> root end

    std::vector<unsigned int> image;
    TailMesh<2>               tail{
        SimplexMesh<2>(reflect(triangulate(half, communicator), 0., image), communicator), {}, {}, {}, image};
    SimplexMesh<2> &mesh = tail.mesh;

    std::vector<unsigned int> upper, lower, upper_root, lower_root;
    curve_edges(mesh, outline.upper_side, side, upper);
    curve_edges(mesh, mirrored_curve(outline.upper_side), images(side, image), lower);
    curve_edges(mesh, outline.upper_root, root, upper_root);
    curve_edges(mesh, mirrored_curve(outline.upper_root), images(root, image), lower_root);

    tail.surface_nodes = lower;
    tail.surface_nodes.insert(tail.surface_nodes.end(), upper.rbegin() + 1, upper.rend());
    tail.clamped_nodes = upper_root;
    tail.clamped_nodes.insert(tail.clamped_nodes.end(), lower_root.begin() + 1, lower_root.end());
    if (numerics.tail_order == 1)
      straighten(mesh);
    refuse_inverted_elements(mesh, "the tail's mesh (origin at the head's centre)");
    tail.axis_at_tip = {n_axis - 2, mesh.edge_node(n_axis - 2, n_axis - 1), n_axis - 1};
    return tail;
  }
} // namespace swimtwin
