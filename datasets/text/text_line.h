// Texts from elsewhere (names, commands, messages) where one line of a file has room for them.
#pragma once

#include <string>

namespace swimtwin
{
  /// Control characters, line breaks among them, become blanks; bytes that are not UTF-8 become the sign for that.
  std::string text_line(const std::string &text);

  /// At most the first forty bytes of a text in UTF-8, for a sentence that quotes it, and `...` for what is left out.
  std::string shortened(const std::string &text);
} // namespace swimtwin
