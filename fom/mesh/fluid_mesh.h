// The mesh of the fluid around the swimmer as it is now, and the names of its boundary nodes.
#pragma once

#include <datasets/scene/scene.h>
#include <fom/geometry/planar_curve.h>
#include <fom/geometry/rigid_pose.h>
#include <fom/geometry/simplex_mesh.h>
#include <fom/mesh/body_mesh.h>

namespace swimtwin
{
  struct WallNode
  {
    unsigned int node;
    const Wall  *wall; ///< at a corner the stronger condition (wall_loop.cc)
    std::string  wall_name;
  };

  template <int dim>
  struct FluidMesh
  {
    SimplexMesh<dim>          mesh;
    std::vector<unsigned int> surface_nodes; ///< mesh node of every node of the swimmer's surface, same order
    std::vector<WallNode>     wall_nodes;
    std::vector<unsigned int> image_of_vertex; ///< of a mesh that is its own mirror image, else empty
  };

  /// Mesh the fluid around a swimmer's surface (laboratory positions, quadratic loop, counter-clockwise), which is kept
  /// node for node, with `surface_size` (m) at each of its vertices. A domain that moves with the swimmer is placed by
  /// the pose. Collective; throws ComputationError, InvertedElement if an element is inside out.
  FluidMesh<2> make_fluid_mesh(const Domain &domain, const std::vector<dealii::Point<2>> &surface,
                               const std::vector<double> &surface_size, const RigidPose<2> &pose,
                               const RigidPose<2> &pose_at_rest, const Numerics &numerics, MPI_Comm communicator);

  /// The same where the surface is its own mirror image at the height of the domain's centre: mesh the upper half and
  /// reflect it.
  FluidMesh<2> make_symmetric_fluid_mesh(const Domain &domain, const std::vector<dealii::Point<2>> &surface,
                                         const std::vector<double> &surface_size, const RigidPose<2> &pose,
                                         const RigidPose<2> &pose_at_rest, const Numerics &numerics,
                                         MPI_Comm communicator);

  /// The fluid around a body in space, whose surface nodes are at x, mirror images of each other at z = 0: meshed at
  /// z >= 0 and reflected. `center`: of the domain. Collective; throws as above.
  FluidMesh<3> make_fluid_mesh(const Domain &domain, const BodyMesh<3> &body, const std::vector<dealii::Point<3>> &x,
                               const dealii::Point<3> &center, const Numerics &numerics, MPI_Comm communicator);

  /// The same where nothing is known of mirror images, meshed as a whole.
  FluidMesh<3> make_whole_fluid_mesh(const Domain &domain, const BodyMesh<3> &body,
                                     const std::vector<dealii::Point<3>> &x, const dealii::Point<3> &center,
                                     const Numerics &numerics, MPI_Comm communicator);

  /// A fluid mesh as plain data, to be written and made again node for node.
  template <int dim>
  struct FluidMeshRecord
  {
    SimplexSoup<dim>                soup;
    std::vector<dealii::Point<dim>> nodes;
    std::vector<unsigned int>       surface_nodes, wall_nodes;
    std::vector<std::string>        wall_names; ///< of each wall node
    std::vector<unsigned int>       image_of_vertex;
  };

  template <int dim>
  FluidMeshRecord<dim> record(const FluidMesh<dim> &fluid_mesh);
  template <int dim>
  FluidMesh<dim> make_fluid_mesh(const Domain &domain, const FluidMeshRecord<dim> &record, MPI_Comm communicator);

  /// Velocity (m/s) that a wall imposes at a point; zero for no-slip. Not for traction-free walls.
  template <int dim>
  dealii::Tensor<1, dim> wall_velocity(const Domain &domain, const std::string &wall_name, const dealii::Point<dim> &x,
                                       double time_s);

  inline constexpr const char *name_of_fluid_mesh = "the fluid's mesh";
} // namespace swimtwin
