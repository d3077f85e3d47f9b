// Triangles of STL files, written as text or in bytes.
#pragma once

#include <datasets/surface/surface_soup.h>

#include <string_view>

namespace swimtwin
{
  /// Every triangle has points of its own. Throws InputError: a file that is cut off, no triangles, words that are no
  /// numbers, coordinates that are not finite, with line or triangle.
  SurfaceSoup read_stl(const std::filesystem::path &file, std::string_view content);
} // namespace swimtwin
