// Outlines of a swimmer in motion, in the laboratory frame.
#pragma once

#include <datasets/run/snapshot_set.h>
#include <datasets/scene/scene.h>

#include <array>
#include <vector>

namespace swimtwin
{
  using Outline = std::vector<std::array<double, 2>>; ///< closed, in m; the first point is not repeated

  struct Pose
  {
    double x_m = 0., y_m = 0., angle_rad = 0.;
  };

  Outline head_outline(const Head &head, const Pose &pose);

  /// Edges of the quadratic mesh that belong to one cell only, as chains of nodes (vertex, midpoint, vertex, ...), one
  /// closed chain per boundary; the first node is not repeated.
  std::vector<std::vector<int>> boundary_chains(const Eigen::MatrixXi &cells);

  /// The tail's boundaries at a snapshot: x_h + R(angle) (X + d), curved edges by short chords.
  std::vector<Outline> tail_outlines(const SnapshotSet &snapshots, std::size_t snapshot);
} // namespace swimtwin
