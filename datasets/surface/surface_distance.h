// How far points are from a surface, and on which side of it.
#pragma once

#include <datasets/surface/closed_surface.h>

#include <memory>
#include <vector>

namespace swimtwin
{
  /// Of the flat triangles that stand for its faces.
  class SurfaceDistance
  {
  public:
    explicit SurfaceDistance(const ClosedSurface &surface);

    struct Nearest
    {
      double       distance_m; ///< not negative
      unsigned int face;
    };

    Nearest nearest(const Eigen::Vector3d &x) const;
    double  to(const Eigen::Vector3d &x) const { return nearest(x).distance_m; }
    bool    encloses(const Eigen::Vector3d &x) const;

  private:
    struct Tree;

    std::vector<Eigen::Vector3d>             points_;
    std::vector<std::array<unsigned int, 3>> triangles_;
    unsigned int                             triangles_per_face_;
    std::shared_ptr<const Tree>              tree_;
  };

  /// Largest distance (m) of the reflection of a surface's points at the plane z = height from the surface.
  double distance_from_mirror_image(const ClosedSurface &surface, double height_m);
} // namespace swimtwin
