// Powers and reactions of one instant.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/fluid/fluid_domain.h>

#include <optional>

namespace swimtwin
{
  /// Force (N) and torque (N m) about the head's centre, per unit depth in 2D; what a plane has none of is zero.
  struct Load
  {
    std::array<double, 3> force{}, torque{};
  };

  /// W, J and N per unit depth in 2D.
  struct PowerBalance
  {
    double              magnetic = 0., gravity = 0., wall = 0., dissipation = 0., elastic_energy = 0.;
    double              drive           = 0.; ///< of what gives the head or the shape a prescribed motion
    double              kinetic_energy  = 0.;
    double              kinetic_outflow = 0.; ///< kinetic energy that the fluid carries out of the domain
    double              stabilization   = 0.; ///< what keeps streams smooth on a coarse mesh dissipates
    double              kinetic_growth = 0.; ///< power of the inertia as the time step has it; the energy grows by less
    Load                load_of_fluid;       ///< on the body
    Load                load_that_holds_head; ///< zero for a free head, with its own inertia for a driven one
    std::vector<double> surface_force;        ///< of the swimmer's surface nodes on the fluid, components together
  };

  /// `fluid` may be null; else its mesh is at the configuration and `fluid_values` are its rows' values. `acceleration`
  /// is the body's, rates of its velocities, where it has inertia. Collective.
  template <int dim>
  PowerBalance power_balance(const Swimmer<dim> &swimmer, const FluidDomain<dim> *fluid,
                             const std::vector<double> &fluid_values, const Configuration<dim> &configuration,
                             const Rates<dim> &rates, double time_s,
                             const std::optional<BodyVelocities<dim>> &acceleration = {});
} // namespace swimtwin
