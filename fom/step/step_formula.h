// What the two-step formula makes of two instants that are past, before a step is solved, and of its end.
#pragma once

#include <fom/algebra/bdf2.h>
#include <fom/coupling/coupling.h>
#include <fom/step/instant.h>

#include <optional>

namespace swimtwin
{
  /// Angle, shape and, as its centre, the middle of the body as far as they are known. Without an instant before `now`
  /// pass that twice.
  template <int dim>
  Configuration<dim> known_configuration(const Swimmer<dim> &swimmer, const Bdf2 &bdf, const Instant<dim> &now,
                                         const Instant<dim> &before);

  /// The same for the velocities of a body with inertia.
  template <int dim>
  std::optional<BodyVelocities<dim>> known_velocities(const Swimmer<dim> &swimmer, const Bdf2 &bdf,
                                                      const Instant<dim> &now, const Instant<dim> &before);

  /// Rates extrapolated by `growth` times the last step; the last ones where it is zero.
  template <int dim>
  Rates<dim> extrapolated_rates(const Instant<dim> &now, const Instant<dim> &before, double growth);

  /// What the scene prescribes, in the place of what stands there: rates that lead to it at the end of the step.
  template <int dim>
  void take_given_rates(const Swimmer<dim> &swimmer, const TimeStep<dim> &step, Rates<dim> &rates);

  /// Rates of the velocities at the end of the step, `now`, of a body with inertia.
  template <int dim>
  std::optional<BodyVelocities<dim>> acceleration(const Swimmer<dim> &swimmer, const TimeStep<dim> &step,
                                                  const Instant<dim> &now);
} // namespace swimtwin
