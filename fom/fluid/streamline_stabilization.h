// What keeps a flow smooth where the mesh is too coarse for its Reynolds number: dissipation along the stream of what
// varies within a cell (local projection). Off on every cell whose Reynolds number Galerkin's method bears.
//
// S. Ganesan, L. Tobiska, "Stabilization by local projection for convection-diffusion and incompressible flow
// problems", J. Sci. Comput. 43, 326-342, 2010; the projection is onto constants here, the nodes' distance along the
// stream that of T. E. Tezduyar, Comput. Methods Appl. Mech. Engrg. 190, 411-430, 2000.
#pragma once

#include <fom/fluid/fluid_inertia.h>

#include <optional>

namespace swimtwin
{
  /// rho tau int k(b . grad u) . k(b . grad v) with the mean carrier b of the cell and k(f) = f less its mean on the
  /// cell: symmetric, never negative, zero for uniform streams and for shear. Its error is of order 3/2 in the mesh
  /// size.
  template <int dim>
  class StreamlineStabilization
  {
  public:
    /// Above this Reynolds number |b| h rho / mu of a cell, h = twice its nodes' distance along the stream (m).
    static constexpr double largest_resolved_reynolds_number = 100.;

    /// Of a cell that needs it.
    static std::optional<StreamlineStabilization> of(const IsoparametricCell<dim> &cell, const FluidInertia &inertia,
                                                     const CellFlow<dim> &flow, const double viscosity_Pa_s)
    {
      if (!inertia.is_convective)
        return std::nullopt;
      double                 volume = 0., passed = 0.;
      dealii::Tensor<1, dim> b;
      for (unsigned int q = 0; q < cell.n_points(); ++q)
      {
        volume += cell.weight(q);
        for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
          b += cell.weight(q) * cell.value(q, a) * inertia.carrier<dim>(flow.fluid[a], flow.mesh[a]);
      }
      b /= volume;
      for (unsigned int q = 0; q < cell.n_points(); ++q)
        for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
          passed += cell.weight(q) * std::abs(b * cell.gradient(q, a));
      // |b| / distance = passed / (2 volume)
      const double speed_square = b.norm_square(), rate_1_s = passed / (2. * volume);
      const double reynolds_number = 2. * inertia.density_kg_m3 * speed_square / (viscosity_Pa_s * rate_1_s);
      if (!(reynolds_number > largest_resolved_reynolds_number))
        return std::nullopt;
      return StreamlineStabilization(
          cell, b, inertia.density_kg_m3 / (2. * rate_1_s) * (1. - largest_resolved_reynolds_number / reynolds_number),
          volume);
    }

    /// Entry of the matrix for one component at nodes a and b.
    double entry(const IsoparametricCell<dim> &cell, const unsigned int a, const unsigned int b) const
    {
      double sum = 0.;
      for (unsigned int q = 0; q < cell.n_points(); ++q)
        sum += cell.weight(q) * variation(cell, q, a) * variation(cell, q, b);
      return weight_ * sum;
    }

    /// Add it to a cell's matrix.
    void add(const IsoparametricCell<dim> &cell, FluidCellMatrix<dim> &matrix) const
    {
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
        for (unsigned int b = 0; b <= a; ++b)
        {
          const double value = entry(cell, a, b);
          for (int i = 0; i < dim; ++i)
          {
            matrix[a * dim + i][b * dim + i] += value;
            if (b < a)
              matrix[b * dim + i][a * dim + i] += value;
          }
        }
    }

    /// Add its forces on a cell's nodes. Returns the power that it dissipates (W, per unit depth in 2D).
    double add_forces(const IsoparametricCell<dim> &cell, const CellFlow<dim> &flow,
                      std::array<double, n_fluid_cell_dofs<dim>> &force) const
    {
      double power = 0.;
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      {
        dealii::Tensor<1, dim> sum;
        for (unsigned int b = 0; b < n_cell_nodes<dim>; ++b)
          sum += entry(cell, a, b) * flow.fluid[b];
        for (int i = 0; i < dim; ++i)
          force[a * dim + i] += sum[i];
        power += sum * flow.fluid[a];
      }
      return power;
    }

  private:
    StreamlineStabilization(const IsoparametricCell<dim> &cell, const dealii::Tensor<1, dim> &carrier,
                            const double weight, const double volume)
        : carrier_(carrier), weight_(weight)
    {
      mean_.fill(0.);
      for (unsigned int q = 0; q < cell.n_points(); ++q)
        for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
          mean_[a] += cell.weight(q) / volume * (carrier_ * cell.gradient(q, a));
    }

    double variation(const IsoparametricCell<dim> &cell, const unsigned int q, const unsigned int a) const
    {
      return carrier_ * cell.gradient(q, a) - mean_[a];
    }

    dealii::Tensor<1, dim>                carrier_; ///< m/s
    double                                weight_;  ///< density times tau (kg s/m^3)
    std::array<double, n_cell_nodes<dim>> mean_;    ///< of carrier . grad of a node's function (1/s)
  };
} // namespace swimtwin
