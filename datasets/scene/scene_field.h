// The field of a scene, replaced as a whole: overrides reach single entries only.
#pragma once

#include <string>

namespace swimtwin
{
  /// The scene's text without its table [field], and a new one that plays a field program (a file name as it is to
  /// stand in the scene) with this period.
  std::string with_field_program(const std::string &scene_text, const std::string &program, double period_s);
} // namespace swimtwin
