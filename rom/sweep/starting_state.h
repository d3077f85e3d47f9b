// Where a run starts that another swimmer's state, or that of another basis, is given for.
#pragma once

#include <rom/swimmer/reduced_swimmer.h>

namespace swimtwin
{
  /// The pose and the leading modes of a state, its velocities zero.
  inline SwimmerState starting_state(const ReducedSwimmer &swimmer, const SwimmerState &state)
  {
    SwimmerState start                 = state_at_rest(swimmer);
    start.head(swimmer.n_velocities()) = state.head(swimmer.n_velocities());
    return start;
  }
} // namespace swimtwin
