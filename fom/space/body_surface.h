// Half of the surface of a body in space, z >= 0, in the head's frame: what its meshes are made from.
#pragma once

#include <datasets/scene/scene.h>
#include <fom/mesh/body_mesh.h>
#include <fom/surface/revolved_surface.h>

#include <optional>

namespace swimtwin
{
  /// Patches of a tail: below the first its root, from the second on the plane z = 0.
  inline constexpr int root_patch = 0, first_side_patch = 100, plane_patch_number = 1000;

  /// Half of a tail's closed surface: root, side, and the plane above and below its axis.
  struct TailSurface
  {
    QuadraticSurface              surface;
    std::vector<dealii::Point<3>> axis; ///< root to tip, a quadratic curve
  };

  struct BodySurface
  {
    QuadraticSurface           head; ///< less the tail's root
    std::optional<TailSurface> tail;
    MeridianTrace              trace; ///< of the whole body: from the nose to the tip, or the back
    SpatialSizeField           size;  ///< wanted edge length (m) on the surface
  };

  /// Head and tail turned about x. Collective.
  BodySurface revolved_body(const Scene &scene, MPI_Comm communicator);
  /// A film behind a cylinder. Collective.
  BodySurface film_body(const Scene &scene, MPI_Comm communicator);

  /// A body whose surface is that of the scene's head, in the head's frame, with the tail that is part of it; no mirror
  /// image is known of it. Collective.
  BodyMesh<3> body_of_surface(const Scene &scene, MPI_Comm communicator);

  /// From the faces: which nodes are vertices, and the mean length of the edges there.
  void set_vertices_and_sizes(BodyMesh<3> &body);

  /// The two parts of the plane z = 0 inside a tail, between its axis and its trace there.
  void add_plane_patches(TailSurface &tail, const MeridianTrace &trace, const SpatialSizeField &size,
                         MPI_Comm communicator);
} // namespace swimtwin
