// Works of the first steps of a run whose load jumps at t = 0: force times the way gone.
#pragma once

#include <datasets/run/work_balance.h>
#include <fom/step/instant.h>
#include <fom/step/power_balance.h>

namespace swimtwin
{
  /// Steps of the time grid over which works are integrated along the way at most: a tenth of a period.
  int n_start_steps(const TimeSettings &time);

  /// Whether field, gravity or walls load a tail in a fluid at t = 0, so that rates start with a jump. (Without a tail
  /// the rates at t = 0 are known.)
  template <int dim>
  bool starts_under_load(const Swimmer<dim> &swimmer);

  /// Whether the power that is put in rose over a step: what a jump left behind decays.
  bool powers_are_smooth_again(const PowerBalance &before, const PowerBalance &now);

  /// Work from one accepted instant to the next: the mean of the two forces times the displacement, of the field and of
  /// gravity on the body, and of the body's surface on the fluid. Powers cannot tell it where a load has just jumped:
  /// rates are then singular in time, forces along the way are not (docs/equations.md, section 11). `balance_before` is
  /// null at the start, where the fluid carries all that loads the body.
  template <int dim>
  IntervalWork work_along_the_way(const Swimmer<dim> &swimmer, const Instant<dim> &before,
                                  const PowerBalance *balance_before, const Instant<dim> &now,
                                  const PowerBalance &balance);
} // namespace swimtwin
