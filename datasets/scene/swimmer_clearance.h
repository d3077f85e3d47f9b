// How far a swimmer at rest is from the walls around it.
#pragma once

#include <datasets/scene/scene.h>

#include <array>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Where the straight sides of a tail begin (on the head's surface) and end, along x from the head's centre.
  struct TailOutline
  {
    double x_root_m = 0.;
    double x_end_m  = 0.; ///< the tip of a flat tail; one tip radius before the tip of a rounded one
    double x_tip_m  = 0.;
  };

  TailOutline tail_outline(const Head &head, const Tail &tail);

  /// Points of the swimmer's outline at its initial pose, in m: corners, and curves by short chords.
  std::vector<std::array<double, 2>> swimmer_outline(const Scene &scene);

  struct Clearance
  {
    std::string wall;            ///< the closest one
    double      distance_m = 0.; ///< negative: the swimmer reaches that far beyond it
  };

  /// Needs a scene with a domain.
  Clearance swimmer_clearance(const Scene &scene);
} // namespace swimtwin
