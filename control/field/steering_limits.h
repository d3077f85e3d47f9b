// What the limits of coils leave of a carrier that is turned to any direction.
#pragma once

#include <control/field/field_limits.h>
#include <rom/swimmer/driving_field.h>

#include <optional>

namespace swimtwin
{
  /// Largest |dB/dt| over the frequency (T per period) of a carrier turned at a rate of at most this, either way (rad
  /// per period). With B = R(a) C, |dB/dt| = |C' + a' J C| f, J a right angle, is convex in a'.
  double largest_slew_T_per_period(const Drive &carrier, double turn_rate);

  /// The fastest turn (rad per period, at most `fastest`) that keeps |dB/dt| within the limit at the carrier's
  /// frequency; negative if the carrier itself does not.
  double largest_turn_rate(const Drive &carrier, double slew_rate_T_s, double fastest);

  struct BrokenLimit
  {
    std::string key; ///< of [limits]
    std::string problem;
  };
  /// The first bound on |B|, components or currents that the carrier breaks in some direction; a sentence that follows
  /// the entry.
  std::optional<BrokenLimit> limit_broken_when_turned(const Drive &carrier, const FieldLimits &limits);
} // namespace swimtwin
