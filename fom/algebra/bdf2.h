// The two-step backward differentiation formula on steps of unequal size.
#pragma once

namespace swimtwin
{
  /// y(t + dt) = y(t) + before_weight (y(t - dt_before) - y(t)) + slope_weight y'(t + dt). With dt_before = 0 it is
  /// the backward Euler formula, which starts a run. Zero-stable while dt < (1 + sqrt(2)) dt_before. Hairer, Norsett,
  /// Wanner, Solving Ordinary Differential Equations I, section III.5.
  struct Bdf2
  {
    double before_weight, slope_weight;

    Bdf2(const double dt, const double dt_before)
    {
      const double r = dt_before > 0. ? dt / dt_before : 0.;
      before_weight  = -r * r / (1. + 2. * r);
      slope_weight   = dt * (1. + r) / (1. + 2. * r);
    }

    /// The part that is known before the step; exactly `now` of what does not change.
    template <typename T>
    T known(const T &now, const T &before) const
    {
      return now + before_weight * (before - now);
    }
  };
} // namespace swimtwin
