// How far a swimmer at rest is from the walls around it.
#pragma once

#include <datasets/scene/tail_outline.h>

#include <array>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Points of the swimmer's outline at its initial pose, in the plane of motion, in m: corners, and curves by short
  /// chords.
  std::vector<std::array<double, 2>> swimmer_outline(const Scene &scene);

  struct Clearance
  {
    std::string wall;            ///< the closest one
    double      distance_m = 0.; ///< negative: the swimmer reaches that far beyond it
  };

  /// Needs a scene with a domain.
  Clearance swimmer_clearance(const Scene &scene);

  /// "the gap of 5e-06 m to the outer wall"
  std::string gap_in_words(const Clearance &clearance);
} // namespace swimtwin
