// The mesh size that a scene needs, found by trying.
#pragma once

#include <datasets/scene/scene.h>
#include <datasets/system/error.h>

#include <functional>
#include <string>

namespace swimtwin
{
  /// A mesh at rest, as it is made anew with smaller sizes.
  struct FinerMesh
  {
    /// Makes it of a scene like the one refused and says whether it is good, or throws ComputationError or InputError.
    std::function<bool(const Scene &)> is_meshed;
    /// About as many as it would have.
    std::function<double(const Scene &)> expected_cells;
    /// What else the scene's owner can do, where the geometry is to blame; else empty.
    std::string remedy;
  };

  /// Refuse the scene's mesh size because of an error, other than of memory, in meshing it at rest. Throws InputError
  /// that names the size to use, or that none is small enough, of those whose meshes are made in seconds, with the
  /// remedy. Where none is and there is no remedy the error is thrown again as it is.
  [[noreturn]] void refuse_mesh_size(const Scene &scene, const ComputationError &error, const FinerMesh &mesh);
} // namespace swimtwin
