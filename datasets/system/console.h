// Words for people: results on standard output, warnings and errors on standard error. The one place that prints.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace swimtwin
{
  /// Text that may quote files of users, as a terminal may have it: what is not printable, which it would obey, is
  /// written out (\x1B), and of an endless line the beginning and the end are left.
  std::string displayable(std::string_view text);

  /// To standard output, at once. Never throws: what could not be written is remembered for finish_output().
  void say_text(std::string_view text);

  template <typename... Values>
  void say(fmt::format_string<Values...> format, Values &&...values)
  {
    say_text(fmt::format(format, std::forward<Values>(values)...));
  }

  /// To standard error as it is, at once. Never throws: where standard error cannot be written, nobody can be told.
  void mutter(std::string_view text);
  /// "swimtwin: SENTENCE" on standard error, displayable.
  void remark(std::string_view sentence);
  /// "swimtwin: warning: SENTENCE" on standard error.
  void warn(std::string_view sentence);

  /// Why standard output was lost since the last call; nothing if all was written, or if its reader wanted no more (a
  /// pipe into `head`).
  std::string why_output_was_lost();
} // namespace swimtwin
