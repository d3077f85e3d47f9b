// Motions of a tail behind its head, in the plane and in space.
#pragma once

#include <fom/body/swimmer.h>

#include <cmath>

namespace swimtwin
{
  /// By 10 per metre times the distance from the head squared, times the amount.
  template <int dim>
  NodalField<dim> bending_of(const Swimmer<dim> &swimmer, const double amount)
  {
    NodalField<dim> field(swimmer.tail().mesh.n_nodes());
    for (unsigned int a = 0; a < field.size(); ++a)
      if (!swimmer.is_clamped(a))
        field[a][1] = amount * 10. * std::pow(swimmer.tail().mesh.nodes[a][0] - swimmer.scene().head.size_m[0] / 2, 2);
    return field;
  }

  /// Along the axis: changes what the body encloses.
  template <int dim>
  NodalField<dim> stretching_of(const Swimmer<dim> &swimmer)
  {
    NodalField<dim> field(swimmer.tail().mesh.n_nodes());
    for (unsigned int a = 0; a < field.size(); ++a)
      if (!swimmer.is_clamped(a))
        field[a][0] = swimmer.tail().mesh.nodes[a][0] - swimmer.scene().head.size_m[0] / 2;
    return field;
  }
} // namespace swimtwin
