// A swimmer's body at a shape and a pose, as the full-order model has it.
#pragma once

#include <fom/body/swimmer.h>
#include <rom/training/sample_store.h>

#include <array>
#include <optional>

namespace swimtwin
{
  /// Along a channel nothing but its ends is felt, so that the body's middle stays where it was at rest but for the
  /// point's drift; `height_m` of the head's centre above that at rest, where it is told.
  template <int dim>
  Configuration<dim> posed(const Swimmer<dim> &swimmer, const ShapePoint &point, NodalField<dim> shape,
                           std::optional<double> height_m);

  /// Where the head's centre is (m) of the straight body that is turned to an angle about its middle, which stays where
  /// the scene has it: turned about its head, the middle would be beside its place in a channel. A domain that moves
  /// along is centred as the scene has it, and so is the head.
  std::array<double, 2> turned_center_m(const Scene &scene, double angle_rad);
} // namespace swimtwin
