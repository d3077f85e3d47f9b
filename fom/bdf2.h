// The two-step backward differentiation formula on steps of unequal size.
#pragma once

namespace swimtwin
{
  /// y(t + dt) = now_weight y(t) + before_weight y(t - dt_before) + slope_weight y'(t + dt). With dt_before = 0 it is
  /// the backward Euler formula, which starts a run. Zero-stable while dt < (1 + sqrt(2)) dt_before. Hairer, Norsett,
  /// Wanner, Solving Ordinary Differential Equations I, section III.5.
  struct Bdf2
  {
    double now_weight, before_weight, slope_weight;

    Bdf2(const double dt, const double dt_before)
    {
      const double r = dt_before > 0. ? dt / dt_before : 0.;
      now_weight     = (1. + r) * (1. + r) / (1. + 2. * r);
      before_weight  = -r * r / (1. + 2. * r);
      slope_weight   = dt * (1. + r) / (1. + 2. * r);
    }

    /// The part that is known before the step.
    template <typename T>
    T known(const T &now, const T &before) const
    {
      return now_weight * now + before_weight * before;
    }
  };
} // namespace swimtwin
