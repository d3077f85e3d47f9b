#include <fom/geometry/simplex_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  using namespace dealii;

  template <int dim>
  SimplexMesh<dim>::SimplexMesh(const SimplexSoup<dim> &soup, const MPI_Comm communicator)
      : triangulation_(std::make_unique<parallel::shared::Triangulation<dim>>(
            communicator, Triangulation<dim>::none, false,
            parallel::shared::Triangulation<dim>::Settings::partition_metis))
  {
    std::vector<CellData<dim>> cell_data;
    cell_data.reserve(soup.cells.size());
    for (const auto &corners : soup.cells)
    {
      CellData<dim> cell(dim + 1);
      std::copy(corners.begin(), corners.end(), cell.vertices.begin());
      cell_data.push_back(cell);
    }
    triangulation_->create_triangulation(soup.vertices, cell_data, SubCellData());

    edges_.resize(triangulation_->n_raw_lines());
    cells.reserve(triangulation_->n_active_cells());
    for (const auto &cell : triangulation_->active_cell_iterators())
    {
      CellNodes<dim> cell_nodes;
      for (const auto v : cell->vertex_indices())
        cell_nodes[v] = cell->vertex_index(v);
      for (const auto l : cell->line_indices())
      {
        const Edge         ends = edge_between(cell->line(l)->vertex_index(0), cell->line(l)->vertex_index(1));
        const unsigned int line = cell->line(l)->index();
        edges_[line]            = ends;
        cell_nodes[dim + 1 + l] = n_vertices() + line;
        edge_of_vertices_[ends] = line;
      }
      cells.push_back(cell_nodes);
      owned_.push_back(cell->is_locally_owned());
    }

    nodes = triangulation_->get_vertices();
    for (const auto &[a, b] : edges_)
      nodes.push_back(0.5 * (nodes[a] + nodes[b]));
  }

  template <int dim>
  unsigned int SimplexMesh<dim>::edge_node(const unsigned int vertex_a, const unsigned int vertex_b) const
  {
    return n_vertices() + edge_of_vertices_.at(edge_between(vertex_a, vertex_b));
  }

  double element_quality(const std::array<Point<2>, 6> &x)
  {
    // Columns of the Jacobian, dx/dr and dx/ds, are linear; the determinant is quadratic in (r, s) and lies above its
    // smallest Bernstein coefficient.
    const auto determinant = [&](const double r, const double s) {
      const double       l  = 1. - r - s;
      const Tensor<1, 2> dr = (4 * r - 1) * x[1] - (4 * l - 1) * Tensor<1, 2>(x[0]) + 4 * (l - r) * Tensor<1, 2>(x[3]) +
                              4 * s * (x[4] - x[5]);
      const Tensor<1, 2> ds = (4 * s - 1) * x[2] - (4 * l - 1) * Tensor<1, 2>(x[0]) + 4 * (l - s) * Tensor<1, 2>(x[5]) +
                              4 * r * (x[4] - x[3]);
      return dr[0] * ds[1] - dr[1] * ds[0];
    };
    const double v0 = determinant(0, 0), v1 = determinant(1, 0), v2 = determinant(0, 1);
    const double m01 = 2 * determinant(.5, 0) - .5 * (v0 + v1), m12 = 2 * determinant(.5, .5) - .5 * (v1 + v2),
                 m20      = 2 * determinant(0, .5) - .5 * (v2 + v0);
    const double smallest = std::min({v0, v1, v2, m01, m12, m20});
    const double sides    = (x[1] - x[0]).norm_square() + (x[2] - x[1]).norm_square() + (x[0] - x[2]).norm_square();
    return 2. * std::sqrt(3.) * smallest / sides;
  }

  double element_quality(const std::array<Point<3>, 10> &x)
  {
    // The Jacobian's columns are linear, and known at the vertices; the determinant is a cubic polynomial, whose
    // Bernstein coefficients are means over the ways to take each column at one of three vertices.
    constexpr int mid_edge[4][4] = {{0, 4, 6, 7}, {4, 0, 5, 8}, {6, 5, 0, 9}, {7, 8, 9, 0}};
    Tensor<1, 3>  column[3][4]; // by coordinate, at a vertex
    for (int at = 0; at < 4; ++at)
    {
      const auto slope = [&](const int v) -> Tensor<1, 3> {
        return v == at ? 3. * Tensor<1, 3>(x[v]) : 4. * Tensor<1, 3>(x[mid_edge[v][at]]) - Tensor<1, 3>(x[v]);
      };
      for (int j = 0; j < 3; ++j)
        column[j][at] = slope(j + 1) - slope(0);
    }
    std::array<double, 64> sum{};
    std::array<int, 64>    count{};
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
      {
        const Tensor<1, 3> normal = cross_product_3d(column[0][a], column[1][b]);
        for (int c = 0; c < 4; ++c)
        {
          std::array<int, 3> taken{a, b, c};
          std::sort(taken.begin(), taken.end());
          const int index = 16 * taken[0] + 4 * taken[1] + taken[2];
          sum[index] += normal * column[2][c];
          ++count[index];
        }
      }
    double smallest = std::numeric_limits<double>::max(), edges = 0.;
    for (int i = 0; i < 64; ++i)
      if (count[i] > 0)
        smallest = std::min(smallest, sum[i] / count[i]);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b)
        edges += (x[a] - x[b]).norm_square() / 6.;
    return std::sqrt(2.) * smallest / (edges * std::sqrt(edges));
  }

  template <int dim>
  double worst_quality(const SimplexMesh<dim> &mesh, const std::vector<Point<dim>> &positions)
  {
    double worst = std::numeric_limits<double>::max();
    for (const auto &cell : mesh.cells)
      worst = std::min(worst, element_quality(cell_positions<dim>(cell, positions)));
    return worst;
  }

  template double worst_quality<2>(const SimplexMesh<2> &, const std::vector<Point<2>> &);
  template double worst_quality<3>(const SimplexMesh<3> &, const std::vector<Point<3>> &);
  template class SimplexMesh<2>;
  template class SimplexMesh<3>;
} // namespace swimtwin
