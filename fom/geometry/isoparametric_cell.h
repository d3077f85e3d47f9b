// Quadratic shape functions on a curved simplex: values, gradients and integration weights at quadrature points.
#pragma once

#include <fom/geometry/simplex_mesh.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace swimtwin
{
  /// Tabulates the reference element once; reinit() maps it to a cell. One per thread of work, not shared.
  template <int dim>
  class IsoparametricCell
  {
  public:
    static constexpr unsigned int n_nodes = n_cell_nodes<dim>;

    /// Quadrature exact to polynomial degree 2 n - 1 on straight cells.
    explicit IsoparametricCell(const unsigned int n = 3)
        : quadrature_(n), gradients_(quadrature_.size()), weights_(quadrature_.size())
    {
      const dealii::FE_SimplexP<dim> quadratic(2), linear(1);
      for (const auto &point : quadrature_.get_points())
      {
        auto &row = reference_.emplace_back();
        for (unsigned int a = 0; a < n_nodes; ++a)
        {
          row.value[a]    = quadratic.shape_value(a, point);
          row.gradient[a] = quadratic.shape_grad(a, point);
        }
        for (unsigned int v = 0; v <= dim; ++v)
          row.linear_value[v] = linear.shape_value(v, point);
      }
    }

    /// Map to the cell whose nodes are at x.
    void reinit(const std::array<dealii::Point<dim>, n_nodes> &x)
    {
      for (unsigned int q = 0; q < n_points(); ++q)
      {
        dealii::Tensor<2, dim> jacobian; // dx_i / dxi_j
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              jacobian[i][j] += x[a][i] * reference_[q].gradient[a][j];
        const dealii::Tensor<2, dim> inverse_transpose = transpose(invert(jacobian));
        for (unsigned int a = 0; a < n_nodes; ++a)
          gradients_[q][a] = inverse_transpose * reference_[q].gradient[a];
        weights_[q] = determinant(jacobian) * quadrature_.weight(q);
      }
    }

    unsigned int n_points() const { return quadrature_.size(); }
    double       weight(const unsigned int q) const { return weights_[q]; }
    double       value(const unsigned int q, const unsigned int a) const { return reference_[q].value[a]; }
    double linear_value(const unsigned int q, const unsigned int v) const { return reference_[q].linear_value[v]; }
    const dealii::Tensor<1, dim> &gradient(const unsigned int q, const unsigned int a) const
    {
      return gradients_[q][a];
    }

    /// Position of a quadrature point of the cell at x.
    dealii::Point<dim> position(const unsigned int q, const std::array<dealii::Point<dim>, n_nodes> &x) const
    {
      dealii::Point<dim> p;
      for (unsigned int a = 0; a < n_nodes; ++a)
        p += value(q, a) * x[a];
      return p;
    }

  private:
    struct ReferencePoint
    {
      std::array<double, n_nodes>                 value;
      std::array<double, dim + 1>                 linear_value;
      std::array<dealii::Tensor<1, dim>, n_nodes> gradient;
    };
    dealii::QGaussSimplex<dim>                               quadrature_;
    std::vector<ReferencePoint>                              reference_;
    std::vector<std::array<dealii::Tensor<1, dim>, n_nodes>> gradients_;
    std::vector<double>                                      weights_;
  };
} // namespace swimtwin
