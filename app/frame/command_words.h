// The words of a command line, looked at before they are parsed: what is wrong with them is said in one sentence.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Throws InputError for a verb or an option that does not exist (names the nearest), a value that is missing or
  /// empty, an option given twice that takes one value, a value for a flag, and a word too many. `words` are those
  /// behind the tool's name. What is missing altogether, and what values mean, is for the parser.
  void check_command_words(const CLI::App &tool, const std::vector<std::string> &words);
} // namespace swimtwin
