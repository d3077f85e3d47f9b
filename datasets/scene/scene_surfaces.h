// The surfaces that a scene names: what they are in it, and what they leave of its planar motions.
#pragma once

#include <datasets/scene/scene.h>
#include <datasets/text/toml_table.h>

namespace swimtwin
{
  /// Make `surface`, `surface_unit_m` and `surface_sha256` known entries of [head] or [domain].
  void declare_surface(TomlTable &table);

  /// Read the files of a head or a domain of that shape, place them, and note their digests in the document. Relative
  /// paths are relative to `folder`. Throws InputError.
  void read_surfaces(TomlDocument &document, const std::filesystem::path &folder, Scene &scene);

  /// A clause, empty if the scene's surfaces are their own mirror images at z = 0 but for 1 % of their extent.
  std::string asymmetric_surface(const Scene &scene);

  /// A sentence for each surface with triangles of a quality below 0.05, which are the mesh there.
  std::vector<std::string> sliver_warnings(const Scene &scene);

  /// The nodes of the head's surface where it starts, in the laboratory (m).
  ClosedSurface surface_at_start(const Head &head);
} // namespace swimtwin
