// When a watchdog barks.
#pragma once

namespace swimtwin
{
  struct WatchOptions
  {
    double sight_lost_s   = 0.5;  ///< without a frame that could be used
    int    frozen_frames  = 20;   ///< of exactly the same values
    int    n_consistency  = 100;  ///< innovations whose mean is watched
    double consistency    = 1e-6; ///< probability, of one window, below which they are not consistent
    double wall_clearance = 1.;   ///< body lengths between the head's centre and a wall
    double step_out_turns = 1.;   ///< half turns of the head against the field's mean direction, in a period
  };
} // namespace swimtwin
