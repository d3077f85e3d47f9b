// How the triangles of a file hang together, and what is inside of them.
#pragma once

#include <datasets/surface/surface_soup.h>

#include <optional>

namespace swimtwin
{
  /// Points at the same place become one, points without a triangle go. If that leaves edges open, points that a
  /// rounding has parted (two millionths of the surface's extent at most) become one, too.
  void merge_points(SurfaceSoup &soup);

  /// One clause with remedy on what keeps the triangles from being a closed surface: triangles without area, open
  /// edges, edges of three triangles and more, points where it touches itself. Nothing if it is one.
  std::optional<std::string> flaw_in(const SurfaceSoup &soup);

  /// Turn triangles until neighbours agree, and number the connected parts from 0. A clause if one has one side only.
  std::optional<std::string> orient_alike(SurfaceSoup &soup, std::vector<unsigned int> &part_of_face);

  /// Turn a part of an oriented surface over.
  void turn_over(SurfaceFace &face);

  /// How many times the surface of these faces goes round x: 1 inside, 0 outside, if they are oriented outwards.
  double winding_number(const std::vector<Eigen::Vector3d>             &points,
                        const std::vector<std::array<unsigned int, 3>> &triangles, const Eigen::Vector3d &x);
} // namespace swimtwin
