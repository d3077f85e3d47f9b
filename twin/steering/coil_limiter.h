// The last thing before the coils: whatever a plan says, they are told nothing that they cannot play.
#pragma once

#include <control/field/field_limits.h>

namespace swimtwin
{
  class CoilLimiter
  {
  public:
    explicit CoilLimiter(const FieldLimits &limits);

    /// Largest bound that a field breaks, as a ratio to it: at most 1 where all are kept (the slew rate aside).
    double use_of(const Eigen::Vector2d &field_T) const;
    /// The same direction, weaker if need be.
    Eigen::Vector2d limited(const Eigen::Vector2d &field_T) const;
    /// From a field that keeps the limits towards another one, no faster than the coils change. Both ends keep the
    /// limits, which are convex, so that all in between do.
    Eigen::Vector2d moved(const Eigen::Vector2d &from_T, const Eigen::Vector2d &to_T, double time_s) const;
    /// How long it takes to move there; 0 without a bound on the slew rate.
    double time_to_move_s(const Eigen::Vector2d &from_T, const Eigen::Vector2d &to_T) const;

  private:
    FieldLimits limits_;
  };
} // namespace swimtwin
