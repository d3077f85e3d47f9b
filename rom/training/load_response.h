// What loads do to a tail beside bending it.
#pragma once

#include <rom/training/bent_tail.h>

namespace swimtwin
{
  /// A tail of least energy at given bending coordinates is in equilibrium under the couples that hold them. A fluid
  /// pushes it sideways instead: the tail shears, and its sections give way. This is what that adds, linear in q.
  struct LoadResponse
  {
    Eigen::MatrixXd fields;    ///< of displacements per coordinate, dim n_nodes x r
    Eigen::MatrixXd stiffness; ///< its energy is q . stiffness q / 2 over Young's modulus, r x r (m in space)
  };

  /// From the full-order model's displacements (one per column) at coordinates `q`.
  template <int dim>
  LoadResponse fit_load_response(const Swimmer<dim> &swimmer, const TailSpace &space, const BentTail &least_energy,
                                 const Eigen::MatrixXd &displacements, const Eigen::MatrixXd &q);
} // namespace swimtwin
