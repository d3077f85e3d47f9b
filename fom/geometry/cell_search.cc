#include <fom/geometry/cell_search.h>

#include <fom/geometry/quadratic_shape.h>

#include <boost/geometry/index/rtree.hpp>

#include <algorithm>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// Box around a quadratic cell: it lies in the hull of its Bezier points.
    template <int dim>
    BoundingBox<dim> box_around(const SimplexMesh<dim> &mesh, const CellNodes<dim> &cell,
                                const std::vector<Point<dim>> &positions)
    {
      std::vector<Point<dim>> hull;
      for (unsigned int v = 0; v <= dim; ++v)
        hull.push_back(positions[cell[v]]);
      for (unsigned int a = dim + 1; a < n_cell_nodes<dim>; ++a)
      {
        const auto &ends = mesh.edges()[cell[a] - mesh.n_vertices()];
        hull.push_back(Point<dim>(2. * positions[cell[a]] - .5 * (positions[ends[0]] + positions[ends[1]])));
      }
      return BoundingBox<dim>(hull);
    }

    /// By how much reference coordinates violate x_i >= 0 and sum x_i <= 1.
    template <int dim>
    double violation(const Point<dim> &reference)
    {
      double sum = 0., worst = 0.;
      for (int i = 0; i < dim; ++i)
      {
        sum += reference[i];
        worst = std::max(worst, -reference[i]);
      }
      return std::max(worst, sum - 1.);
    }
  } // namespace

  template <int dim>
  CellSearch<dim>::CellSearch(const SimplexMesh<dim> &mesh, const std::vector<Point<dim>> &positions)
      : mesh_(mesh), positions_(positions)
  {
    std::vector<std::pair<Box, unsigned int>> boxes;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      boxes.emplace_back(box_around(mesh, mesh.cells[c], positions), c);
    boxes_ = pack_rtree(boxes);
  }

  template <int dim>
  std::optional<PointInCell<dim>> CellSearch<dim>::invert(const unsigned int cell, const Point<dim> &x) const
  {
    constexpr int    most_steps = 30;
    constexpr double round_off  = 1e-13;
    PointInCell<dim> result;
    result.cell = cell;
    for (int i = 0; i < dim; ++i)
      result.reference[i] = 1. / (dim + 1.);
    const auto &nodes = mesh_.cells[cell];
    for (int step = 0; step < most_steps; ++step)
    {
      const auto     shape    = quadratic_shape(result.reference);
      Tensor<1, dim> residual = x;
      Tensor<2, dim> jacobian;
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      {
        residual -= shape.value[a] * positions_[nodes[a]];
        jacobian += outer_product(Tensor<1, dim>(positions_[nodes[a]]), shape.gradient[a]);
      }
      const Tensor<1, dim> change = dealii::invert(jacobian) * residual;
      result.reference += change;
      if (change.norm() < round_off)
        break;
      if (!(change.norm() < 10.))
        return std::nullopt;
    }
    result.value   = quadratic_shape(result.reference).value;
    result.outside = violation<dim>(result.reference);
    return result;
  }

  template <int dim>
  std::optional<PointInCell<dim>> CellSearch<dim>::find(const Point<dim> &x) const
  {
    namespace bgi                          = boost::geometry::index;
    constexpr double                inside = 1e-10, beside = 0.5;
    std::optional<PointInCell<dim>> best;
    const auto                      consider = [&](const unsigned int cell) {
      const auto candidate = invert(cell, x);
      if (candidate && (!best || candidate->outside < best->outside))
        best = candidate;
      return best && best->outside <= inside;
    };
    for (const auto &[box, cell] : boxes_ | bgi::adaptors::queried(bgi::intersects(x)))
      if (consider(cell))
        return best;
    for (const auto &[box, cell] : boxes_ | bgi::adaptors::queried(bgi::nearest(x, 8)))
      if (consider(cell))
        return best;
    return best && best->outside <= beside ? best : std::nullopt;
  }

  template class CellSearch<2>;
  template class CellSearch<3>;
} // namespace swimtwin
