// The shapes that the reduced tail can take: modes whose amplitudes are coordinates, and modes that follow them.
#pragma once

#include <datasets/run/snapshot_set.h>
#include <fom/geometry/simplex_mesh.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <memory>
#include <string>
#include <vector>

namespace swimtwin
{
  struct BentTail;
  struct TailSpace;

  /// d(X; q) = sum_i q_i phi_i + sum_k p_k(q) psi_k with p_k a quadratic form: a tail that bends shortens. All modes
  /// are orthonormal in the mean over the tail. Bending modes (odd under the mirror) are coordinates; a product of two
  /// of them is even, and so are the followers.
  ///
  /// Or, if `bent` is there, that alone: coordinates are bending angles, and all modes follow them.
  struct TailBasis
  {
    std::shared_ptr<const BentTail> bent;
    Eigen::MatrixXd                 coordinates; ///< dim n_nodes x r
    Eigen::MatrixXd                 followers;   ///< dim n_nodes x s
    Eigen::MatrixXd                 quadratic;   ///< s x r (r + 1) / 2; q_i q_j, j <= i, is column i (i + 1) / 2 + j
    Eigen::VectorXd singular_values; ///< of bending and symmetric snapshots together, by size; empty without snapshots
    double          energy_captured = 0.; ///< share of the snapshots' energy that the basis, followers included, holds
    double          projection_error_m = 0.; ///< root mean square over snapshots and tail of what it cannot represent

    int n_coordinates() const;
    /// Coordinates of displacements, one column each.
    Eigen::MatrixXd coordinates_of(const TailSpace &space, const Eigen::MatrixXd &displacements) const;
    int             n_followers() const { return static_cast<int>(followers.cols()); }

    Eigen::VectorXd follower_amplitudes(const Eigen::VectorXd &q) const;
    /// The tail's displacement, and its derivative by q (dim n_nodes x r).
    Eigen::VectorXd displacement(const Eigen::VectorXd &q) const;
    Eigen::MatrixXd tangent(const Eigen::VectorXd &q) const;
  };

  /// The products q_i q_j, j <= i, and their derivative by q.
  Eigen::VectorXd products(const Eigen::VectorXd &q);
  Eigen::MatrixXd products_derivative(const Eigen::VectorXd &q);

  /// Where tail fields live: the mean product (1/A) int u . v over the tail, and the image of a field in the mirror
  /// y -> -y.
  struct TailSpace
  {
    Eigen::MatrixXd             nodes_m;
    Eigen::SparseMatrix<double> mean_product;
    Eigen::SparseMatrix<double> mirror;
    std::vector<unsigned int>   images; ///< of nodes at the plane of motion in space; empty where there are none

    /// Displacements of the tail that were saved on these nodes, one per column, of one set after the other.
    Eigen::MatrixXd displacements(const std::vector<SnapshotSet> &sets) const;
    /// Throws InputError naming `origin` if the set has another tail mesh.
    void require_same_mesh(const SnapshotSet &set, const std::string &origin) const;
    /// Fields (interleaved components, one per column) under the mirror.
    Eigen::MatrixXd mirrored(const Eigen::MatrixXd &fields) const { return mirror * fields; }
    /// Amplitudes of orthonormal fields (columns) in others.
    Eigen::MatrixXd amplitudes(const Eigen::MatrixXd &orthonormal, const Eigen::MatrixXd &fields) const
    {
      return orthonormal.transpose() * (mean_product * fields);
    }
    /// Fields that are their own images at the plane of motion but for rounding, made so: nodes on it stay on it.
    Eigen::MatrixXd kept_to_plane(const Eigen::MatrixXd &fields) const;
    double          norm(const Eigen::VectorXd &field) const;
    /// What orthonormal fields leave of another.
    Eigen::VectorXd orthogonal_part(const Eigen::MatrixXd &orthonormal, Eigen::VectorXd field) const;
  };

  /// Throws ComputationError if the mesh is not symmetric.
  TailSpace make_tail_space(const SnapshotSet &set);
  /// The same where the mesh, from which the set was made, need not be: in space, where only the plane z = 0 is a
  /// mirror of meshes, a field's image is interpolated.
  template <int dim>
  TailSpace make_tail_space(const SnapshotSet &set, const SimplexMesh<dim> &mesh);

  void append_column(Eigen::MatrixXd &matrix, const Eigen::VectorXd &column);
} // namespace swimtwin
