// Works over a stretch of a trajectory, and whether they balance.
#pragma once

#include <datasets/run/trajectory.h>

#include <optional>
#include <span>

namespace swimtwin
{
  /// Work done from one row to the next, per unit depth (J/m), where it was integrated more finely than the powers of
  /// the two rows tell.
  struct IntervalWork
  {
    double magnetic_J_m = 0., external_J_m = 0., dissipated_J_m = 0.;

    IntervalWork &operator+=(const IntervalWork &next);
  };

  /// Of the rows of a trajectory, by the trapezoidal rule on their powers; by `first_intervals` from the first row on,
  /// as far as these go. The rows are not empty.
  WorkBalance work_balance(std::span<const TrajectoryRow> rows, std::span<const IntervalWork> first_intervals = {});

  /// The balance of every full period, in their order. Needs rows at every multiple of the period.
  std::vector<WorkBalance> work_balance_per_period(const Trajectory &trajectory, double period_s,
                                                   std::span<const IntervalWork> first_intervals = {});

  /// Imbalance that a smooth motion may have at so many steps per period: the balance is of second order in the step.
  /// 0.5 % (100/n)^2, at least 0.1 % and at most 5 %. With inertia a third of that: motion is then off by a hundredth
  /// of the body length where the balance is open by 1 % (docs/stress.md).
  double largest_expected_imbalance(int steps_per_period, bool has_inertia = false);

  /// The period whose imbalance is largest, counted from 0; none if no period has one.
  std::optional<std::size_t> worst_period(const std::vector<WorkBalance> &periods);
} // namespace swimtwin
