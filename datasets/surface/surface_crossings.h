// Where triangles of surfaces go through each other.
#pragma once

#include <datasets/surface/closed_surface.h>

namespace swimtwin
{
  using FlatTriangles = std::vector<std::array<unsigned int, 3>>;

  struct Crossings
  {
    std::size_t     n_pairs = 0;                       ///< of triangles that meet where they must not
    Eigen::Vector3d first   = Eigen::Vector3d::Zero(); ///< a point near the first
  };

  /// Triangles that share no more than a corner or an edge, and meet elsewhere, or lie folded on each other. Decided in
  /// whole numbers, on a grid of 2^40 points along the extent of the surface: no pair is missed or made up by rounding.
  Crossings self_crossings(const std::vector<Eigen::Vector3d> &points, const FlatTriangles &triangles);

  /// Triangles of the first surface that meet triangles of the second one.
  Crossings crossings(const std::vector<Eigen::Vector3d> &points, const FlatTriangles &triangles,
                      const std::vector<Eigen::Vector3d> &other_points, const FlatTriangles &other_triangles);
} // namespace swimtwin
