// Where an output came from.
#pragma once

#include <string>

namespace swimtwin
{
  /// `swimtwin 0.1.0`: of this build.
  extern const char *const current_program_version;

  struct Provenance
  {
    std::string program_version; ///< of the build that computed
    std::string command_line;
    std::string scene_text;
    std::string scene_hash;
    std::string created; ///< UTC, ISO 8601
    double      wall_time_s = 0.;
  };

  /// SHA-256 of a text, hexadecimal.
  std::string digest(const std::string &text);

  /// Now in UTC, ISO 8601 to the second: 2025-01-31T12:00:00Z.
  std::string utc_time_now();
} // namespace swimtwin
