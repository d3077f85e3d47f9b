// A closed surface of triangles in space: a rigid body, or the walls around a fluid.
#pragma once

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Three vertices, then the middles of the edges 01, 12, 20.
  using SurfaceFace = std::array<unsigned int, 6>;

  struct ClosedSurface
  {
    std::filesystem::path        file;
    std::string                  sha256;            ///< of the file's content
    std::vector<Eigen::Vector3d> nodes;             ///< m
    std::vector<SurfaceFace>     faces;             ///< their normals point out of what the surface encloses
    bool                         is_curved = false; ///< else every middle is that of a straight edge
    std::vector<std::string>     patches;           ///< names of the parts of the surface, at least one
    std::vector<unsigned int>    patch_of_face;
  };

  /// Integrals over what a surface encloses, exact for quadratic faces.
  struct EnclosedVolume
  {
    double          volume_m3        = 0.;
    Eigen::Vector3d center_m         = Eigen::Vector3d::Zero(); ///< mean position
    Eigen::Matrix3d second_moment_m5 = Eigen::Matrix3d::Zero(); ///< int r r^T dV, r from the centre
  };

  EnclosedVolume enclosed_volume(const ClosedSurface &surface);

  /// What is said of the triangles: as they are, for the mesh is made of them.
  struct TriangleSizes
  {
    double mean_edge_m = 0., longest_edge_m = 0.;
    double worst_quality = 1.; ///< of the flat triangles: 1 if equilateral, 0 without area
  };

  TriangleSizes triangle_sizes(const ClosedSurface &surface);

  /// Twice the area over the sum of the squared edges, scaled to 1 for an equilateral triangle.
  double triangle_quality(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &c);

  struct Extent
  {
    Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();

    Eigen::Vector3d size() const { return high - low; }
  };

  Extent extent(const std::vector<Eigen::Vector3d> &points);

  /// Corners of flat triangles that stand for the faces: each as it is, or by four between its nodes if it is curved.
  std::vector<std::array<unsigned int, 3>> flat_triangles(const std::vector<SurfaceFace> &faces, bool is_curved);
} // namespace swimtwin
