// The fluid's terms on one cell: Stokes flow, P2 velocity and P1 pressure.
#pragma once

#include <fom/geometry/isoparametric_cell.h>

namespace swimtwin
{
  /// Local unknowns of a fluid cell: velocity component c of node a at a * dim + c, then the vertices' pressures.
  template <int dim>
  constexpr unsigned int n_fluid_cell_dofs = n_cell_nodes<dim> *dim + dim + 1;

  template <int dim>
  using FluidCellMatrix = std::array<std::array<double, n_fluid_cell_dofs<dim>>, n_fluid_cell_dofs<dim>>;

  /// int 2 mu D(u):D(v) - s p div v - s q div u, symmetric. The pressure unknown is the pressure divided by s (Pa), so
  /// that both blocks have entries of like size: pass a typical mu / length.
  ///
  /// Inertia's place is here: rho (du/dt + (u - w) . grad u) . v is one more cell term of this file.
  template <int dim>
  void stokes_cell_matrix(const IsoparametricCell<dim> &cell, const double viscosity, const double pressure_scale,
                          FluidCellMatrix<dim> &matrix)
  {
    constexpr unsigned int n = n_cell_nodes<dim>;
    for (auto &row : matrix)
      row.fill(0.);
    for (unsigned int q = 0; q < cell.n_points(); ++q)
    {
      const double mu = viscosity * cell.weight(q), s = pressure_scale * cell.weight(q);
      for (unsigned int a = 0; a < n; ++a)
      {
        const auto &ga = cell.gradient(q, a);
        for (unsigned int b = 0; b <= a; ++b)
        {
          const auto  &gb  = cell.gradient(q, b);
          const double dot = mu * (ga * gb);
          for (int i = 0; i < dim; ++i)
          {
            matrix[a * dim + i][b * dim + i] += dot;
            for (int j = 0; j < dim; ++j)
              matrix[a * dim + i][b * dim + j] += mu * ga[j] * gb[i];
          }
        }
        for (int i = 0; i < dim; ++i)
          for (unsigned int v = 0; v <= dim; ++v)
            matrix[n * dim + v][a * dim + i] -= s * cell.linear_value(q, v) * ga[i];
      }
    }
    for (unsigned int i = 0; i < n_fluid_cell_dofs<dim>; ++i)
      for (unsigned int j = 0; j < i; ++j)
        matrix[j][i] = matrix[i][j];
  }
} // namespace swimtwin
