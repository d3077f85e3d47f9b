// Text in rows and cells: which character separates them, and where quotes keep it from doing so.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  /// A row of a text; quotes may hold line ends, so that it may be several lines long.
  struct TextRow
  {
    std::size_t line = 0; ///< its first
    std::string text;
  };

  struct DelimitedText
  {
    char                 separator = ','; ///< a blank: any number of them
    std::vector<TextRow> rows;            ///< neither empty nor comments
  };

  /// Rows and separator of a UTF-8 text with LF line ends: what a first line `sep=;` says, else the one among tab, `;`,
  /// `,`, `|` and blanks that stands in the first row; of several, the one that makes all rows equally long. Throws
  /// InputError with `file` in front if more than one does, and for a `sep=` that is none of them.
  DelimitedText split_rows(std::string_view text, const std::string &file);

  /// Cells without blanks around them and without their double quotes, of which two inside stand for one.
  std::vector<std::string> split_cells(std::string_view row, char separator);
} // namespace swimtwin
