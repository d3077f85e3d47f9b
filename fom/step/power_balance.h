// Powers and reactions of one instant.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>

namespace swimtwin
{
  /// W, J and N per unit depth in 2D.
  struct PowerBalance
  {
    double                magnetic = 0., gravity = 0., wall = 0., dissipation = 0., elastic_energy = 0.;
    std::array<double, 3> load_that_holds_head = {0., 0., 0.}; ///< force x, y, torque; zero for a free head
    std::vector<double>   surface_force; ///< of the swimmer's surface nodes on the fluid, components together
  };

  /// `fluid` may be null; else its mesh is at the configuration and `fluid_values` are its rows' values. Collective.
  template <int dim>
  PowerBalance power_balance(const Swimmer<dim> &swimmer, const FluidDomain<dim> *fluid,
                             const std::vector<double> &fluid_values, const Configuration<dim> &configuration,
                             const Rates<dim> &rates, double time_s);
} // namespace swimtwin
