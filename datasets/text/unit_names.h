// Units as people and programs write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  /// How many `to` one `from` is: ("mm", "m") gives 1e-3. None if they do not measure the same, or one is not known.
  /// Known are SI symbols with their prefixes and what is made of them (`um`, `µm`, `mm_s`, `mm/s`, `kPa`, `kA_m`,
  /// `g_cm3`), words (`micron`, `millimeter`, `sec`, `minutes`), `rad_s` and `rpm` of a frequency, `deg`, `inch`, `G`,
  /// `cP`; brackets around a unit do not count.
  std::optional<double> unit_factor(std::string_view from, std::string_view to);

  /// Whether a unit is a pixel of the camera, whose size only the laboratory knows.
  bool is_pixel(std::string_view unit);

  /// The unit that one was before its sign for micro was damaged on the way (`Âµm`, `?m`, `\u00B5m` -> `um`);
  /// none if it is no such unit.
  std::optional<std::string> repaired_unit(std::string_view unit);

  /// `(micron)` or `[micron]` -> `micron`.
  std::string_view without_brackets(std::string_view unit);

  /// A name that says its unit: `displacement_mm`, `Displacement (mm)`.
  struct NameWithUnit
  {
    std::string stem; ///< in lower case, `_` for blanks
    std::string unit; ///< as it was written; empty if the name says none
  };
  /// `Position X [um]` -> `position_x` and `um`; without brackets the unit is empty.
  NameWithUnit split_brackets(std::string_view name);
  /// Every way to read a name: all of it, what stands before brackets, before each `_`.
  std::vector<NameWithUnit> readings_of(std::string_view name);

  /// The reading of a name whose unit is known, the longest one: `mean_speed_mm_s` -> `mean_speed` and `mm_s`.
  std::optional<NameWithUnit> reading_with_unit(std::string_view name);
  /// `displacement_m` in `cm` is `displacement_cm`.
  std::string name_in_unit(std::string_view name, std::string_view unit);

  /// What to multiply numbers called `name` with to call them `wanted` (`displacement_mm`, `displacement_m`); none if
  /// they are not the same quantity or a unit is not known.
  std::optional<double> factor_between_names(std::string_view name, std::string_view wanted);
} // namespace swimtwin
