// What inertia has to know of an instant that is past.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace swimtwin
{
  /// Where the nodes of the fluid's mesh were (m) and how fast the fluid was there (m/s).
  template <int dim>
  struct FluidMotion
  {
    std::vector<dealii::Point<dim>>     positions;
    std::vector<dealii::Tensor<1, dim>> velocity;
  };

  /// The last two accepted instants on one mesh, whose nodes carry them along: nothing is interpolated.
  template <int dim>
  struct FluidPast
  {
    FluidMotion<dim> now, before;
  };
} // namespace swimtwin
