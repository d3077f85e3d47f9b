#include <datasets/surface/surface_distance.h>

#include <datasets/surface/surface_topology.h>
#include <datasets/surface/triangle_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  using Eigen::Vector3d;

  struct SurfaceDistance::Tree
  {
    TriangleTree tree;
  };

  namespace
  {
    double distance_to_segment(const Vector3d &x, const Vector3d &a, const Vector3d &b)
    {
      const Vector3d along = b - a;
      const double   s     = std::clamp((x - a).dot(along) / along.squaredNorm(), 0., 1.);
      return (x - a - s * along).norm();
    }

    double distance_to_triangle(const Vector3d &x, const Vector3d &a, const Vector3d &b, const Vector3d &c)
    {
      const Vector3d n         = (b - a).cross(c - a);
      const auto     is_within = [&](const Vector3d &p, const Vector3d &q) { return n.cross(q - p).dot(x - p) >= 0.; };
      if (is_within(a, b) && is_within(b, c) && is_within(c, a))
        return std::abs((x - a).dot(n)) / n.norm();
      return std::min({distance_to_segment(x, a, b), distance_to_segment(x, b, c), distance_to_segment(x, c, a)});
    }
  } // namespace

  SurfaceDistance::SurfaceDistance(const ClosedSurface &surface)
      : points_(surface.nodes), triangles_(flat_triangles(surface.faces, surface.is_curved)),
        triangles_per_face_(surface.is_curved ? 4 : 1),
        tree_(std::make_shared<Tree>(Tree{tree_of(points_, triangles_)}))
  {
  }

  SurfaceDistance::Nearest SurfaceDistance::nearest(const Vector3d &x) const
  {
    namespace geometry = boost::geometry;
    const TreePoint at = tree_point(x);
    Nearest         least{std::numeric_limits<double>::infinity(), 0};
    // By growing distance of their boxes, until these are farther than what was found.
    for (auto near = tree_->tree.qbegin(geometry::index::nearest(at, triangles_.size())); near != tree_->tree.qend();
         ++near)
    {
      if (geometry::distance(at, near->first) > least.distance_m)
        break;
      const auto &[a, b, c] = triangles_[near->second];
      if (const double d = distance_to_triangle(x, points_[a], points_[b], points_[c]); d < least.distance_m)
        least = {d, near->second / triangles_per_face_};
    }
    return least;
  }

  bool SurfaceDistance::encloses(const Vector3d &x) const
  {
    return winding_number(points_, triangles_, x) > .5;
  }

  double distance_from_mirror_image(const ClosedSurface &surface, const double height_m)
  {
    const SurfaceDistance distance(surface);
    double                largest = 0.;
    for (const auto &face : surface.faces)
      for (const unsigned int node : face)
      {
        Vector3d x = surface.nodes[node];
        x[2]       = 2. * height_m - x[2];
        largest    = std::max(largest, distance.to(x));
      }
    return largest;
  }
} // namespace swimtwin
