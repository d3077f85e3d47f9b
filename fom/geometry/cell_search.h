// Which cell of a mesh with curved edges a point lies in, and where in it.
#pragma once

#include <fom/geometry/simplex_mesh.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <optional>

namespace swimtwin
{
  /// A cell, the reference coordinates in it, and the values of its quadratic shape functions there.
  template <int dim>
  struct PointInCell
  {
    unsigned int                          cell;
    dealii::Point<dim>                    reference;
    std::array<double, n_cell_nodes<dim>> value;
    double                                outside; ///< largest violation of the reference cell's inequalities

    template <typename T>
    T interpolate(const CellNodes<dim> &nodes, const std::vector<T> &field) const
    {
      T result = value[0] * field[nodes[0]];
      for (unsigned int a = 1; a < n_cell_nodes<dim>; ++a)
        result += value[a] * field[nodes[a]];
      return result;
    }
  };

  /// Finds candidates by their bounding boxes and inverts the quadratic map of each by Newton's method. Of cells that a
  /// point is outside of by rounding, or beside a curved wall that another mesh divides differently, the nearest one is
  /// taken and its polynomial continued.
  template <int dim>
  class CellSearch
  {
  public:
    /// `positions` of the mesh's nodes; both must outlive this.
    CellSearch(const SimplexMesh<dim> &mesh, const std::vector<dealii::Point<dim>> &positions);

    /// None if the point is further from the mesh than half the size of the cells there.
    std::optional<PointInCell<dim>> find(const dealii::Point<dim> &x) const;

  private:
    std::optional<PointInCell<dim>> invert(unsigned int cell, const dealii::Point<dim> &x) const;

    using Box = dealii::BoundingBox<dim>;
    const SimplexMesh<dim>                     &mesh_;
    const std::vector<dealii::Point<dim>>      &positions_;
    dealii::RTree<std::pair<Box, unsigned int>> boxes_;
  };
} // namespace swimtwin
