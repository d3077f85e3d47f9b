// The walls of the fluid's domain as curve meshes.
#pragma once

#include <fom/geometry/planar_curve.h>
#include <fom/mesh/fluid_mesh.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// A closed boundary: a quadratic loop without repetition (vertex, midpoint, vertex, ...), and the wall of each edge.
  /// Outer loops run counter-clockwise from the middle of their left side, inner ones too. Empty: there is none.
  struct WallLoop
  {
    std::vector<dealii::Point<2>> nodes;
    std::vector<std::string>      wall_of_edge;
  };

  /// Whether the walls are circles.
  bool is_round(const Domain &domain);

  /// Where the domain's centre is when the head has that pose: a domain may move with the swimmer.
  dealii::Point<2> domain_center(const Domain &domain, const RigidPose<2> &pose, const RigidPose<2> &pose_at_rest);

  WallLoop outer_loop(const Domain &domain, const dealii::Point<2> &center, const SizeField &size);
  WallLoop inner_loop(const Domain &domain, const dealii::Point<2> &center, const SizeField &size);

  /// The same, the lower half being the upper one's reflection at the centre's height.
  WallLoop mirrored_outer_loop(const Domain &domain, const dealii::Point<2> &center, const SizeField &size);
  WallLoop mirrored_inner_loop(const Domain &domain, const dealii::Point<2> &center, const SizeField &size);

  /// The wall that a node between two belongs to: one that imposes a velocity wins over an open end, a solid wall over
  /// an inflow, one at rest over a moving one; else bottom and top win, so that mirrored corners are alike.
  const std::string &stronger_wall(const Domain &domain, const std::string &before, const std::string &here);

  /// Append the names of a loop's nodes, whose numbers in the mesh are `nodes`.
  void name_wall_nodes(const Domain &domain, const WallLoop &loop, const std::vector<unsigned int> &nodes,
                       std::vector<WallNode> &wall_nodes);
} // namespace swimtwin
