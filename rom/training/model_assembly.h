// The pieces of a training as one reduced model.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <fom/body/swimmer.h>
#include <rom/training/tail_basis.h>

namespace swimtwin
{
  /// Tail, elasticity, magnet and area of a basis; no resistance yet. `tail` describes the mesh.
  template <int dim>
  ReducedModel assemble_body(const Swimmer<dim> &swimmer, const SnapshotSet &tail, const TailBasis &basis);
} // namespace swimtwin
