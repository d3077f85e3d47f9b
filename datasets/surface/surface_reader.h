// Closed surfaces from files.
#pragma once

#include <datasets/surface/closed_surface.h>

namespace swimtwin
{
  /// What a surface bounds: a solid body in one or more pieces, or a fluid with what stands in it.
  enum class SurfaceUse { body, walls };

  /// Read an STL or a file of gmsh, whose lengths are in units of `unit_m`. Normals are turned outwards, those of
  /// obstacles in a fluid into it. Throws InputError, one sentence with remedy: what no such file is, open edges and
  /// whatever else keeps the triangles from enclosing a volume.
  ClosedSurface read_closed_surface(const std::filesystem::path &file, double unit_m, SurfaceUse use);
} // namespace swimtwin
