// The mass matrix of a tail's quadratic mesh, without finite elements from elsewhere.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace swimtwin
{
  /// Integral of N_i . N_j over the cells, curved triangles or tetrahedra, components interleaved: size nodes_m.size().
  Eigen::SparseMatrix<double> tail_mass_matrix(const Eigen::MatrixXd &nodes_m, const Eigen::MatrixXi &cells);
} // namespace swimtwin
