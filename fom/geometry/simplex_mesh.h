// A triangle or tetrahedron mesh with second-order geometry, known whole on every rank and owned in parts.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/distributed/shared_tria.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <vector>

namespace swimtwin
{
  /// Nodes of a quadratic simplex: its vertices, then the midpoints of its edges (01, 12, 20 in 2D), deal.II's order.
  template <int dim>
  constexpr unsigned int n_cell_nodes = (dim + 1) * (dim + 2) / 2;

  template <int dim>
  using CellNodes = std::array<unsigned int, n_cell_nodes<dim>>;

  using Edge = std::array<unsigned int, 2>; ///< vertices, the smaller number first

  inline Edge edge_between(const unsigned int a, const unsigned int b)
  {
    return {std::min(a, b), std::max(a, b)};
  }

  /// Corners of a mesh as a mesh generator gives them.
  template <int dim>
  struct SimplexSoup
  {
    std::vector<dealii::Point<dim>>                vertices;
    std::vector<std::array<unsigned int, dim + 1>> cells; ///< positively oriented
  };

  template <int dim>
  class SimplexMesh
  {
  public:
    /// Edges are straight; move mid-edge nodes afterwards through `nodes`. Collective.
    SimplexMesh(const SimplexSoup<dim> &soup, MPI_Comm communicator);

    const dealii::Triangulation<dim> &triangulation() const { return *triangulation_; }
    MPI_Comm                          communicator() const { return triangulation_->get_communicator(); }

    unsigned int n_vertices() const { return triangulation_->n_vertices(); }
    unsigned int n_nodes() const { return nodes.size(); }
    unsigned int n_cells() const { return cells.size(); }
    bool         is_owned(const unsigned int cell) const { return owned_[cell]; }

    /// Node in the middle of the edge between two vertices.
    unsigned int edge_node(unsigned int vertex_a, unsigned int vertex_b) const;
    /// Ends of each edge, indexed by mid-edge node minus n_vertices().
    const std::vector<Edge> &edges() const { return edges_; }

    /// Positions (m) of vertices, then of mid-edge nodes.
    std::vector<dealii::Point<dim>> nodes;
    /// Nodes of every active cell, in deal.II's cell order.
    std::vector<CellNodes<dim>> cells;

  private:
    std::unique_ptr<dealii::parallel::shared::Triangulation<dim>> triangulation_; ///< on the heap: others point to it
    std::vector<char>                                             owned_;
    std::vector<Edge>                                             edges_;
    std::map<Edge, unsigned int>                                  edge_of_vertices_;
  };

  /// Put every mid-edge node in the middle of its edge: linear displacements turn a cell rigidly only if its edges are
  /// straight.
  template <int dim>
  void straighten(SimplexMesh<dim> &mesh)
  {
    for (unsigned int e = 0; e < mesh.edges().size(); ++e)
      mesh.nodes[mesh.n_vertices() + e] = .5 * (mesh.nodes[mesh.edges()[e][0]] + mesh.nodes[mesh.edges()[e][1]]);
  }

  /// The nodes of one cell, from positions of all nodes.
  template <int dim>
  std::array<dealii::Point<dim>, n_cell_nodes<dim>> cell_positions(const CellNodes<dim>                  &cell,
                                                                   const std::vector<dealii::Point<dim>> &positions)
  {
    std::array<dealii::Point<dim>, n_cell_nodes<dim>> x;
    for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      x[a] = positions[cell[a]];
    return x;
  }

  /// Quality of a quadratic triangle: a lower bound of its Jacobian determinant (Bernstein coefficients), divided by
  /// the mean squared length of its sides so that an equilateral one has 1 and an inverted one a number <= 0.
  double element_quality(const std::array<dealii::Point<2>, 6> &x);

  /// The same of a quadratic tetrahedron: relative to the cubed root mean square of its edges.
  double element_quality(const std::array<dealii::Point<3>, 10> &x);

  /// Worst element_quality over the mesh at the given node positions.
  template <int dim>
  double worst_quality(const SimplexMesh<dim> &mesh, const std::vector<dealii::Point<dim>> &positions);
} // namespace swimtwin
