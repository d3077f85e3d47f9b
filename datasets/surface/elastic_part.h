// The elastic part of a body that is read from a surface, and the plane that parts it from the rigid rest.
#pragma once

#include <datasets/surface/closed_surface.h>

namespace swimtwin
{
  struct ElasticPart
  {
    std::vector<char>         has_face; ///< whether a face of the body's surface is its own
    std::vector<unsigned int> rim;      ///< nodes of the body's surface, a closed quadratic loop: vertex, middle, ...
  };

  /// The patch of that name. Throws InputError, one sentence with remedy: no such patch, nothing beside it, a rim that
  /// is not one loop in a plane across x, a part that does not lie behind it (along +x).
  ElasticPart elastic_part(const ClosedSurface &body, const std::string &patch);

  /// The elastic part or the rest alone, closed by triangles in the plane of the rim.
  ClosedSurface closed_part(const ClosedSurface &body, const ElasticPart &part, bool is_elastic);
} // namespace swimtwin
