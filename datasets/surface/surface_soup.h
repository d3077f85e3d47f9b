// Triangles as a file holds them, before anything is known of how they hang together.
#pragma once

#include <datasets/surface/closed_surface.h>

namespace swimtwin
{
  struct SurfaceSoup
  {
    std::vector<Eigen::Vector3d> points; ///< in the file's unit of length
    std::vector<SurfaceFace>     faces;  ///< of straight triangles the vertices alone are given
    bool                         is_curved = false;
    std::vector<std::string>     patches;
    std::vector<unsigned int>    patch_of_face;
  };

  /// Of a point, as messages say them: (1, 2, 3).
  std::string coordinates(const Eigen::Vector3d &x);

  /// No machine meshes around more.
  inline constexpr std::size_t n_faces_at_most = 1'000'000;
} // namespace swimtwin
