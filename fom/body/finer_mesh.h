// The mesh size that a scene needs, found by trying.
#pragma once

#include <datasets/scene/scene.h>
#include <datasets/system/error.h>

#include <functional>

namespace swimtwin
{
  /// Refuse the scene's mesh size because of an error in meshing it at rest. `is_meshed` makes the mesh of a scene like
  /// it with a smaller size and says whether it is good, or throws ComputationError or InputError. Throws InputError
  /// that names the size to use, or that none is small enough, of those whose meshes are made in seconds, if there are
  /// any. What no size mends and is not about elements inside out is thrown again as it is, unless a gap is to blame
  /// that `gap` names.
  [[noreturn]] void refuse_mesh_size(const Scene &scene, const ComputationError &error,
                                     const std::function<bool(const Scene &)> &is_meshed, const std::string &gap = {});
} // namespace swimtwin
