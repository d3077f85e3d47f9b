// Pieces of outlines in the plane and their division into edges of prescribed size.
#pragma once

#include <deal.II/base/point.h>

#include <functional>
#include <vector>

namespace swimtwin
{
  /// A straight line, an elliptic arc or the graph of a function, walked from parameter 0 to 1.
  struct PlanarCurve
  {
    std::function<dealii::Point<2>(double)> position;

    static PlanarCurve line(const dealii::Point<2> &from, const dealii::Point<2> &to);
    /// The graph of a function, from one x to another.
    static PlanarCurve graph(std::function<double(double)> height, double from_x, double to_x);
    /// Ellipse with half axes `radii`, from one polar parameter to another (rad).
    static PlanarCurve arc(const dealii::Point<2> &center, const std::array<double, 2> &radii, double from_rad,
                           double to_rad);
  };

  /// Wanted edge length (m) at a point.
  using SizeField = std::function<double(const dealii::Point<2> &)>;

  /// Parameters of the nodes that divide() makes.
  std::vector<double> division(const PlanarCurve &curve, const SizeField &size, unsigned int min_edges = 1);

  /// Nodes of a quadratic curve mesh: vertex, midpoint, vertex, ..., last vertex. All lie on the curve, edges have
  /// equal length in units of the size field and are never longer than it asks; midpoints halve the arc of their edge.
  std::vector<dealii::Point<2>> divide(const PlanarCurve &curve, const SizeField &size, unsigned int min_edges = 1);

  /// Where the size is prescribed at points and grows linearly away from each: min_i (h_i + growth |x - x_i|), at most
  /// `largest`. A plain search in a uniform grid of buckets is not needed at the sizes of 2D outlines.
  SizeField graded_size(std::vector<std::pair<dealii::Point<2>, double>> prescribed, double growth, double largest);
} // namespace swimtwin
