// Exact elastic energy of a basis: Gram matrices of the strains that its modes make.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <fom/body/swimmer.h>

namespace swimtwin
{
  /// Integrals over the tail's mesh, by the quadrature of the full-order tail, so that energy and forces are the
  /// full-order ones at the same shape to round-off. `modes` is 2 n_nodes x R.
  ReducedElasticity compute_strain_grams(const Swimmer<2> &swimmer, const Eigen::MatrixXd &modes);
} // namespace swimtwin
