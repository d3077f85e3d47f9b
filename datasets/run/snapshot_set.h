// Tail shapes over time, on the tail's own mesh: what POD is made from.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  struct Provenance;

  /// Nodes are those of the quadratic tail mesh. Nodal vectors are interleaved (x0, y0, x1, y1, ...), size n = 2
  /// n_nodes.
  struct SnapshotSet
  {
    Eigen::MatrixXd             tail_nodes_m;  ///< n_nodes x dim, reference configuration, origin at the head's centre
    Eigen::MatrixXi             tail_cells;    ///< n_cells x 6: three vertices, then midpoints of edges 01, 12, 20
    Eigen::VectorXi             clamped_nodes; ///< nodes on the head
    Eigen::SparseMatrix<double> tail_mass_m2;  ///< n x n, integral of N_i . N_j over the tail (unit density)
    std::vector<double>         time_s;
    Eigen::MatrixXd             tail_displacement_m; ///< n_snapshots x n, in the head's frame
    Eigen::MatrixXd             tail_velocity_m_s;   ///< n_snapshots x n, rate of the above
    Eigen::MatrixXd             pose;                ///< n_snapshots x 3: x (m), y (m), angle (rad)
    Eigen::MatrixXd             pose_in_space;       ///< n_snapshots x 7: x, y, z (m), unit quaternion w, x, y, z;
                                                     ///< empty for motions in a plane
    Eigen::MatrixXd field_T;                         ///< n_snapshots x 3
  };

  /// Layout (docs/file-formats.md): groups /tail (nodes_m, cells, clamped_nodes, mass in CSR), /snapshots (time_s,
  /// displacement_m, velocity_m_s, pose, field_T), attributes `units` and `description` on every dataset, provenance as
  /// attributes of the root. Written to a temporary name, then renamed.
  void        write_snapshots(const std::filesystem::path &file, const SnapshotSet &set, const Provenance &provenance);
  SnapshotSet read_snapshots(const std::filesystem::path &file);
} // namespace swimtwin
