// The boxes of triangles in a tree, to find those that are near.
#pragma once

#include <datasets/surface/surface_crossings.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace swimtwin
{
  using TreePoint    = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using TreeBox      = boost::geometry::model::box<TreePoint>;
  using TreeEntry    = std::pair<TreeBox, unsigned int>; ///< and the triangle's number
  using TriangleTree = boost::geometry::index::rtree<TreeEntry, boost::geometry::index::rstar<16>>;

  inline TreePoint tree_point(const Eigen::Vector3d &x)
  {
    return {x[0], x[1], x[2]};
  }

  inline TreeBox box_of(const std::vector<Eigen::Vector3d> &points, const std::array<unsigned int, 3> &triangle)
  {
    const Eigen::Vector3d &a = points[triangle[0]], &b = points[triangle[1]], &c = points[triangle[2]];
    return {tree_point(a.cwiseMin(b).cwiseMin(c)), tree_point(a.cwiseMax(b).cwiseMax(c))};
  }

  inline TriangleTree tree_of(const std::vector<Eigen::Vector3d> &points, const FlatTriangles &triangles)
  {
    std::vector<TreeEntry> entries;
    for (unsigned int t = 0; t < triangles.size(); ++t)
      entries.emplace_back(box_of(points, triangles[t]), t);
    return TriangleTree(entries); // packed
  }
} // namespace swimtwin
