// What of a state a period maps onto itself: angle and shape, and with inertia the velocities.
#pragma once

#include <rom/swimmer/reduced_swimmer.h>

#include <vector>

namespace swimtwin
{
  /// What a period's end is differentiated by, in the order of the state behind the position.
  std::vector<Parameter> start_parameters(const ReducedSwimmer &swimmer);

  /// Their units: radians, body lengths and, of velocities, periods.
  Eigen::VectorXd start_units(const ReducedSwimmer &swimmer, double frequency_Hz);
} // namespace swimtwin
