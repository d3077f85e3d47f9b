// How much an observation counts that is farther off than noise takes it.
#pragma once

namespace swimtwin
{
  struct Robustness
  {
    /// Distances are in standard deviations of the innovation (root of its chi-squared). Up to `knee` all counts; from
    /// there an observation counts like one at the knee (Huber's loss), its variance being raised; beyond `gate` it is
    /// taken for an outlier and not used.
    double knee = 3., gate = 5.;

    /// 1 up to the knee, then decreasing, 0 beyond the gate.
    double weight(const double distance, const bool is_gated = true) const
    {
      if (!is_gated && distance > knee)
        return knee / distance;
      return distance <= knee ? 1. : distance <= gate ? knee / distance : 0.;
    }
  };
} // namespace swimtwin
