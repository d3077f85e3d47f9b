// Numbers as they stand in the cells of tables.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swimtwin
{
  /// What the cells of a column say about their decimal mark.
  enum class DecimalMark {
    point,
    comma,
    uncertain ///< a cell with a comma, or one like 1.234 among commas, may mean two numbers
  };

  /// Counts of cells whose mark tells something.
  struct MarkEvidence
  {
    std::size_t n_points       = 0; ///< 0.2
    std::size_t n_commas       = 0; ///< 0,2
    std::size_t n_point_groups = 0; ///< 1.234, which may be a thousand and more
    std::size_t n_comma_groups = 0; ///< 1,234

    void          look_at(std::string_view cell);
    MarkEvidence &operator+=(const MarkEvidence &other);
  };

  /// The mark of a column. Where commas separate the columns, a quoted comma is decimal only if no number of the table
  /// has a point; where semicolons do, as where commas are decimal, points may stand between thousands.
  DecimalMark find_decimal_mark(const MarkEvidence &column, const MarkEvidence &table, char separator);

  /// The finite number of a cell; none where there is none, or where it is not certain.
  std::optional<double> parse_number(std::string_view cell, DecimalMark mark);

  /// What to do about a cell that `parse_number` refuses: "correct it, or leave the row out".
  std::string remedy_for_number(std::string_view cell, DecimalMark mark);
} // namespace swimtwin
