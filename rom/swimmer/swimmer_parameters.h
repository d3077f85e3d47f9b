// What may differ between runs of one reduced swimmer, and names for what to differentiate by.
#pragma once

#include <datasets/scene/scene.h>
#include <rom/swimmer/driving_field.h>

#include <string>

namespace swimtwin
{
  /// Magnet, material and fluid; all positive but the magnetizations.
  struct SwimmerParameters
  {
    double young_modulus_Pa = 0., viscosity_Pa_s = 0.;
    double magnetization_A_m = 0., tail_magnetization_A_m = 0.; ///< of the head and of the tail
  };

  enum class Quantity {
    young_modulus,
    viscosity,
    magnetization,
    tail_magnetization,
    frequency, ///< at fixed phase: the field of the same shape, played faster
    field,     ///< a parameter of the driving field
    initial_angle,
    initial_shape,   ///< a mode's coordinate at the start
    initial_velocity ///< one of R^T dx/dt, omega, dq/dt at the start, with inertia
  };

  /// Of the terms of inertia that a run carries; zero leaves a term out.
  struct InertialDensities
  {
    double fluid_kg_m3 = 0., tail_kg_m3 = 0., head_kg_m3 = 0.;

    bool any() const { return fluid_kg_m3 > 0. || tail_kg_m3 > 0. || head_kg_m3 > 0.; }
  };

  /// One number that a run depends on. `index` counts the field's parameters or the modes.
  struct Parameter
  {
    Quantity quantity = Quantity::young_modulus;
    int      index    = 0;

    bool operator==(const Parameter &) const = default;
  };

  /// Those of a scene with a fluid and a tail. Throws InputError for one without.
  SwimmerParameters swimmer_parameters(const Scene &scene);

  /// The scene's densities, of the terms that are carried. Throws InputError if the fluid's unsteady and convective
  /// terms are not carried together: the reduced swimmer knows only both.
  InertialDensities inertial_densities(const Scene &scene, const InertiaTerms &terms);

  /// How far off a displacement is at most, relative, if inertia is worth `share` of it and the reduced swimmer carries
  /// it, to first order in the fluid's density: a bound on what swimmers in a box and in an open disc show
  /// (docs/study.md, section 6).
  double error_of_carried_inertia(double share, double unsteady_group_of_domain);
} // namespace swimtwin
