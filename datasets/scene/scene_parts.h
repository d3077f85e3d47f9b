// The tables of a scene file, read one by one, and what their readers share.
#pragma once

#include <datasets/scene/scene.h>
#include <datasets/scene/scene_names.h>
#include <datasets/text/toml_table.h>

namespace swimtwin
{
  constexpr NumberRule required(const std::string_view unit, const Range &range = positive)
  {
    return {unit, range, Need::required};
  }
  constexpr NumberRule optional(const std::string_view unit, const Range &range = positive)
  {
    return {unit, range, Need::optional};
  }

  template <typename Enum>
  void read_choice(TomlTable &table, const std::string &key, Enum &target, const Need need = Need::optional)
  {
    table.choice(key, need, Names<Enum>::list, target);
  }

  /// `center_m` of [head] or [domain]: [x, y], in space also [x, y, z].
  std::array<double, 3> read_center(TomlTable &table, int dimension);

  std::optional<FluidProperties> read_fluid(const TomlDocument &document);
  std::optional<Domain>          read_domain(const TomlDocument &document, int dimension);
  /// After surfaces were read, which name the walls of some domains.
  std::map<std::string, Wall> read_walls(const TomlDocument &document, const Domain &domain, int dimension);
  Head                        read_head(const TomlDocument &document, int dimension);
  std::optional<Tail>         read_tail(const TomlDocument &document, const Head &head);
  /// `folder`: what the path of a field program is relative to. Writes the program's digest into the document.
  FieldProgram read_field(TomlDocument &document, const std::filesystem::path &folder);
  Gravity      read_gravity(const TomlDocument &document, int dimension);
  /// Mesh sizes that are not given follow from the scene's body and domain.
  Numerics read_numerics(const TomlDocument &document, const Scene &scene);
} // namespace swimtwin
