// Triangles of mesh files of gmsh, formats 2.2 and 4.1.
#pragma once

#include <datasets/surface/surface_soup.h>

#include <string_view>

namespace swimtwin
{
  /// All triangles of the file, of order 1 or 2; points, lines and tetrahedra are passed over. Patches are its physical
  /// surfaces that have a name; what has none is "outer". Throws InputError: other formats or orders, bytes, no
  /// triangles, quadrangles, a file that is cut off, nodes that are missing or not finite, with the line.
  SurfaceSoup read_msh(const std::filesystem::path &file, std::string_view content);
} // namespace swimtwin
