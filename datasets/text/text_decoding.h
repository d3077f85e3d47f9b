// Text of other systems as UTF-8 with one kind of line end.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace swimtwin
{
  /// The text of a file's bytes: UTF-8, UTF-16 and UTF-32 (with a byte order mark; UTF-16 also without one), else
  /// Windows-1252, which contains Latin-1. Line ends CR LF and CR become LF; the byte order mark goes. Throws
  /// InputError for NUL bytes and for text that is cut inside a character.
  std::string decoded_text(std::string_view bytes, const std::filesystem::path &file);

  /// The decoded text of a file that a person wrote; `what` as for `read_text_file`.
  std::string read_decoded_text(const std::filesystem::path &file, const std::string &what);
} // namespace swimtwin
