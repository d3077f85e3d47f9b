// The tail's rows in a motion map.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/unknowns/motion_map.h>

namespace swimtwin
{
  /// A linear tail: the mid-edge nodes that are not clamped move with the mean of their edge's ends. `row(node,
  /// component)` numbers the rows. A quadratic tail's nodes are free.
  template <int dim, typename Row>
  void tie_linear_tail(MotionMap<dim> &map, const Swimmer<dim> &swimmer, const Row &row)
  {
    if (swimmer.scene().numerics.tail_order != 1)
      return;
    const auto &mesh = swimmer.tail().mesh;
    for (unsigned int e = 0; e < mesh.edges().size(); ++e)
      if (const unsigned int node = mesh.n_vertices() + e; !swimmer.is_clamped(node))
        for (unsigned int c = 0; c < dim; ++c)
          map.tie(row(node, c), {row(mesh.edges()[e][0], c), row(mesh.edges()[e][1], c)});
  }
} // namespace swimtwin
