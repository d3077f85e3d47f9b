// The swimmer's surface at rest, as the curve mesh that fluid and tail share node for node.
#pragma once

#include <datasets/scene/scene.h>
#include <fom/geometry/planar_curve.h>

#include <vector>

namespace swimtwin
{
  /// Nodes in the head frame (origin at the head's centre, tail along +x), mirror symmetric about y = 0. Every list is
  /// a quadratic curve mesh: vertex, midpoint, vertex, ... Lists that meet repeat the shared vertex.
  struct SwimmerOutline
  {
    std::vector<dealii::Point<2>>
        upper_head; ///< nose to the upper end of the tail's root (without a tail: to the back)
    std::vector<dealii::Point<2>> upper_side; ///< root's upper end to the tip; empty without a tail
    std::vector<dealii::Point<2>> upper_root; ///< axis to the root's upper end, along the head's surface
    SizeField                     size;       ///< wanted edge length (m), head frame

    /// The closed surface, counter-clockwise from the nose, without repeating its first vertex.
    std::vector<dealii::Point<2>> surface() const;
    dealii::Point<2>              tip() const { return upper_side.back(); }
  };

  /// The same as curves: the upper half in the half plane of x and distance from the axis.
  struct OutlineCurves
  {
    std::vector<PlanarCurve> head;          ///< nose to where the tail starts (without a tail: to the back)
    std::vector<PlanarCurve> side, root;    ///< of the tail: there to the tip, axis to there; empty without one
    dealii::Point<2>         root_end, tip; ///< of the tail
    SizeField                size;
  };
  OutlineCurves outline_curves(const Head &head, const std::optional<Tail> &tail, const Numerics &numerics);

  SwimmerOutline make_outline(const Head &head, const std::optional<Tail> &tail, const Numerics &numerics);
} // namespace swimtwin
