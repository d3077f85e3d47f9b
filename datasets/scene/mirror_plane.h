// The mirror plane of a scene: half of it then tells the other half.
#pragma once

#include <datasets/scene/scene.h>

#include <string>

namespace swimtwin
{
  /// The plane through the head's centre along x. It exists if geometry, walls and all loads are their own mirror
  /// images at it; then the motion is too, unless it leaves an unstable equilibrium.
  struct MirrorPlane
  {
    std::string missing; ///< one clause: why the scene has none; empty if it has
    std::string doubt;   ///< one clause: what may turn the symmetric motion unstable; empty if nothing does

    bool exists() const { return missing.empty(); }
  };

  MirrorPlane find_mirror_plane(const Scene &scene);

  /// Whether the domain is its own mirror image at that plane: a swimmer that moves as another one's mirror image then
  /// feels the mirror image of its forces. A scene without a fluid is.
  bool domain_is_mirrored(const Scene &scene);

  /// Whether a run solves the upper half and reflects it: when the scene asks for it, or leaves the choice open, has a
  /// plane beyond doubt and is not partitioned.
  bool solves_half(const Scene &scene);

  /// In space: whether a free head keeps to the plane z = 0, with three velocities in the place of six. It does where
  /// half is solved, and where what is read from surfaces is its own mirror image there, though its meshes are not.
  bool moves_in_plane(const Scene &scene);

  /// In space: what pushes or turns a free body out of the plane z = 0, a clause; empty where nothing does.
  std::string way_out_of_plane(const Scene &scene);

  /// A sentence for a run that solves half of a scene whose symmetric motion may be unstable; empty for others.
  std::string symmetry_warning(const Scene &scene);
} // namespace swimtwin
