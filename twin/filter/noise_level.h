// The noise of observations that came without a sigma, learned from their innovations.
#pragma once

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  /// Of one kind of observation. What an innovation has beyond what the state's own uncertainty explains is noise; a
  /// running mean of it, over all that came until there were `memory` of them.
  struct NoiseLevel
  {
    static constexpr double memory = 200.;

    double variance = 0., n = 0.;

    double sigma() const { return std::sqrt(variance); }
    /// `square`: of an innovation, per row; `explained`: the part of its variance that is the state's.
    void learn(const double square, const double explained)
    {
      // What square - explained is off by grows with the variance of both: where the state is unknown, as at a start,
      // an innovation tells nothing of the noise. The first guess counts as ten observations; a variance stays
      // positive.
      const double certainty = variance / (variance + explained), weight = certainty * certainty;
      n                  = std::min(n + weight, memory);
      const double share = weight / (n + 10.);
      variance           = std::max(variance + share * (square - explained - variance), 0.01 * variance);
    }
  };
} // namespace swimtwin
