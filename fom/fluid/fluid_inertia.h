// The fluid's inertia on one cell of a moving mesh: rho (du/dt + (u - w) . grad u), not in conservative form, so that a
// uniform stream stays uniform however the mesh moves.
#pragma once

#include <fom/fluid/stokes.h>

namespace swimtwin
{
  /// Which terms, with what weight.
  struct FluidInertia
  {
    double density_kg_m3 = 0.;
    double rate_1_s      = 0.; ///< du/dt at a node of the moving mesh is rate (u - known); 0: no unsteady term
    bool   is_convective = false;

    /// What carries the flow past a node: the rate at a place is that at the node less w . grad u.
    template <int dim>
    dealii::Tensor<1, dim> carrier(const dealii::Tensor<1, dim> &fluid, const dealii::Tensor<1, dim> &mesh) const
    {
      return (is_convective ? 1. : 0.) * fluid - (rate_1_s > 0. ? 1. : 0.) * mesh;
    }
  };

  /// Velocities (m/s) at the nodes of one cell: of the fluid, of the fluid as far as it is known before the step, and
  /// of the mesh.
  template <int dim>
  struct CellFlow
  {
    std::array<dealii::Tensor<1, dim>, n_cell_nodes<dim>> fluid, known, mesh;
    /// Nodes that go with the fluid: those of the swimmer. What is carried relative to them is zero whatever is solved.
    std::array<bool, n_cell_nodes<dim>> goes_with_fluid{};
  };

  /// The same and the fluid's gradient at a quadrature point.
  template <int dim>
  struct PointFlow
  {
    dealii::Tensor<1, dim> fluid, known, mesh;
    dealii::Tensor<2, dim> gradient; ///< d u_i / d x_j
    double                 mesh_divergence = 0.;

    PointFlow(const IsoparametricCell<dim> &cell, const unsigned int q, const CellFlow<dim> &flow)
    {
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      {
        const double value = cell.value(q, a);
        fluid += value * flow.fluid[a];
        known += value * flow.known[a];
        mesh += value * flow.mesh[a];
        gradient += outer_product(flow.fluid[a], cell.gradient(q, a));
        mesh_divergence += flow.mesh[a] * cell.gradient(q, a);
      }
    }

    dealii::Tensor<1, dim> convection(const FluidInertia &inertia) const
    {
      return gradient * inertia.carrier<dim>(fluid, mesh);
    }
  };

  /// rho rate int u . v, and its part that is known, as a load.
  template <int dim>
  void add_unsteady_term(const IsoparametricCell<dim> &cell, const FluidInertia &inertia, const CellFlow<dim> &flow,
                         FluidCellMatrix<dim> &matrix, std::array<double, n_fluid_cell_dofs<dim>> &load)
  {
    for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      for (unsigned int b = 0; b < n_cell_nodes<dim>; ++b)
      {
        double mass = 0.;
        for (unsigned int q = 0; q < cell.n_points(); ++q)
          mass += cell.weight(q) * cell.value(q, a) * cell.value(q, b);
        mass *= inertia.density_kg_m3 * inertia.rate_1_s;
        for (int i = 0; i < dim; ++i)
        {
          matrix[a * dim + i][b * dim + i] += mass;
          load[a * dim + i] += mass * flow.known[b][i];
        }
      }
  }

  /// rho int ((u - w) . grad u) . v as it is at flow.fluid, as a load: the matrix stays symmetric. (u - w: the
  /// carrier.)
  template <int dim>
  void add_convection_as_load(const IsoparametricCell<dim> &cell, const FluidInertia &inertia,
                              const CellFlow<dim> &flow, std::array<double, n_fluid_cell_dofs<dim>> &load)
  {
    for (unsigned int q = 0; q < cell.n_points(); ++q)
    {
      const dealii::Tensor<1, dim> force =
          inertia.density_kg_m3 * cell.weight(q) * PointFlow<dim>(cell, q, flow).convection(inertia);
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
        for (int i = 0; i < dim; ++i)
          load[a * dim + i] -= cell.value(q, a) * force[i];
    }
  }

  /// The same, linearised at flow.fluid: Newton's method.
  template <int dim>
  void add_linearized_convection(const IsoparametricCell<dim> &cell, const FluidInertia &inertia,
                                 const CellFlow<dim> &flow, FluidCellMatrix<dim> &matrix,
                                 std::array<double, n_fluid_cell_dofs<dim>> &load)
  {
    for (unsigned int q = 0; q < cell.n_points(); ++q)
    {
      const PointFlow<dim>         point(cell, q, flow);
      const double                 weight   = inertia.density_kg_m3 * cell.weight(q);
      const dealii::Tensor<1, dim> relative = inertia.carrier<dim>(point.fluid, point.mesh);
      dealii::Tensor<1, dim>       known; // of what is solved for in the relative velocity
      for (unsigned int b = 0; b < n_cell_nodes<dim>; ++b)
        if (!flow.goes_with_fluid[b])
          known += weight * cell.value(q, b) * (point.gradient * flow.fluid[b]);
      for (unsigned int b = 0; b < n_cell_nodes<dim>; ++b)
      {
        const double carried = weight * (relative * cell.gradient(q, b));
        const auto   carries = weight * cell.value(q, b) * point.gradient;
        for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
          for (int i = 0; i < dim; ++i)
          {
            matrix[a * dim + i][b * dim + i] += cell.value(q, a) * carried;
            for (int j = 0; j < dim && !flow.goes_with_fluid[b]; ++j)
              matrix[a * dim + i][b * dim + j] += cell.value(q, a) * carries[i][j];
          }
      }
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
        for (int i = 0; i < dim; ++i)
          load[a * dim + i] += cell.value(q, a) * known[i];
    }
  }

  /// Energy (J) and powers (W) of the fluid's inertia, per unit depth in 2D.
  struct KineticPowers
  {
    double energy  = 0.; ///< int rho |u|^2 / 2
    double growth  = 0.; ///< of it, as the unsteady term has it, for the mesh's volume as it changes
    double outflow = 0.; ///< carried away through the boundary
  };

  /// Add the forces of the inertia on a cell's nodes, and its energy and powers. On a mesh that moves by w
  /// d/dt int rho |u|^2 / 2 = int rho u . du/dt + int rho |u|^2 div w / 2.
  template <int dim>
  void add_inertial_forces(const IsoparametricCell<dim> &cell, const FluidInertia &inertia, const CellFlow<dim> &flow,
                           std::array<double, n_fluid_cell_dofs<dim>> &force, KineticPowers &powers)
  {
    for (unsigned int q = 0; q < cell.n_points(); ++q)
    {
      const PointFlow<dim>         point(cell, q, flow);
      const double                 weight     = inertia.density_kg_m3 * cell.weight(q);
      const dealii::Tensor<1, dim> unsteady   = weight * inertia.rate_1_s * (point.fluid - point.known),
                                   convection = weight * point.convection(inertia);
      const double energy                     = inertia.rate_1_s > 0. ? .5 * weight * point.fluid.norm_square() : 0.;
      const double by_dilation                = energy * point.mesh_divergence;
      powers.energy += energy;
      powers.growth += unsteady * point.fluid + by_dilation;
      powers.outflow += convection * point.fluid - by_dilation;
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
        for (int i = 0; i < dim; ++i)
          force[a * dim + i] += cell.value(q, a) * (unsteady[i] + convection[i]);
    }
  }
} // namespace swimtwin
