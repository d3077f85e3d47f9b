// Shipped scenes for tests of the full-order model, shrunk by overrides where a test need not see the whole of them.
#pragma once

#include <datasets/scene/scene.h>
#include <tests/places.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  inline Scene shipped_scene(const std::string &name, const std::vector<std::string> &overrides = {})
  {
    return read_scene(std::filesystem::path(places::scenes) / (name + ".toml"), overrides);
  }

  /// "key=value" with enough digits.
  inline std::string override_entry(const std::string &key, const double value)
  {
    char text[64];
    std::snprintf(text, sizeof text, "%.17e", value);
    return key + "=" + text;
  }

  /// The scene's mesh with every length divided by `factor`: elements keep their shapes and places.
  inline std::vector<std::string> refined(const Scene &scene, const double factor)
  {
    const Numerics &n = scene.numerics;
    return {override_entry("numerics.mesh_size_m", n.mesh_size_m / factor),
            override_entry("numerics.mesh_size_corner_m", n.mesh_size_corner_m / factor),
            override_entry("numerics.mesh_size_far_m", n.mesh_size_far_m / factor),
            override_entry("numerics.mesh_growth", n.mesh_growth / factor)};
  }
} // namespace swimtwin
