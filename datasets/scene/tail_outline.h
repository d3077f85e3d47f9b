// The outline of a tail at rest: the curve that is mirrored at the axis in the plane, and turned about it in space.
#pragma once

#include <datasets/scene/scene.h>

#include <array>
#include <vector>

namespace swimtwin
{
  /// Of a tail, along x from the head's centre (m).
  struct TailOutline
  {
    double x_root_m = 0.; ///< where its sides begin, on the head's surface
    double x_end_m  = 0.; ///< where they end: at the tip of a flat tail, one tip radius before that of a rounded one
    double x_tip_m  = 0.;
    /// x and half height (m) of points on the sides, from x_root_m to x_end_m: two of straight ones.
    std::vector<std::array<double, 2>> sides;

    /// Half height (m; in space the radius) of the sides at x: a curve through the points that rises and falls only
    /// where they do.
    double half_height_m(double x_m) const;
  };

  TailOutline tail_outline(const Head &head, const Tail &tail);

  /// Value at x of the piecewise cubic through points with growing x that is monotone wherever they are: derivatives of
  /// F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984), 300-304. At least two points.
  double monotone_interpolation(const std::vector<std::array<double, 2>> &points, double x);
} // namespace swimtwin
