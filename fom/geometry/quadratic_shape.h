// Quadratic shape functions of a simplex at any one point, in closed form: a search evaluates them too often for
// deal.II's general polynomials (isoparametric_cell.h tabulates those once).
#pragma once

#include <datasets/surface/simplex_edges.h>
#include <fom/geometry/simplex_mesh.h>

#include <deal.II/base/tensor.h>

namespace swimtwin
{
  /// Values and gradients with respect to reference coordinates, of all nodes.
  template <int dim>
  struct QuadraticShape
  {
    std::array<double, n_cell_nodes<dim>>                 value;
    std::array<dealii::Tensor<1, dim>, n_cell_nodes<dim>> gradient;
  };

  /// In barycentric coordinates l: l_v (2 l_v - 1) at vertices, 4 l_a l_b on edges.
  template <int dim>
  QuadraticShape<dim> quadratic_shape(const dealii::Point<dim> &reference)
  {
    std::array<double, dim + 1>                 l;
    std::array<dealii::Tensor<1, dim>, dim + 1> slope;
    l[0] = 1.;
    for (int i = 0; i < dim; ++i)
    {
      l[i + 1] = reference[i];
      l[0] -= reference[i];
      slope[i + 1][i] = 1.;
      slope[0][i]     = -1.;
    }
    QuadraticShape<dim> shape;
    for (unsigned int v = 0; v <= dim; ++v)
    {
      shape.value[v]    = l[v] * (2. * l[v] - 1.);
      shape.gradient[v] = (4. * l[v] - 1.) * slope[v];
    }
    for (unsigned int e = 0; e + dim + 1 < n_cell_nodes<dim>; ++e)
    {
      const auto &[a, b]          = simplex_edges[e];
      shape.value[dim + 1 + e]    = 4. * l[a] * l[b];
      shape.gradient[dim + 1 + e] = 4. * (l[a] * slope[b] + l[b] * slope[a]);
    }
    return shape;
  }
} // namespace swimtwin
