#include <datasets/text/number_text.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr std::string_view true_minus = "\u2212";

    bool is_digit(const char c)
    {
      return c >= '0' && c <= '9';
    }

    std::optional<double> parse_with_point(std::string_view cell)
    {
      if (cell.starts_with('+'))
        cell.remove_prefix(1);
      double value             = 0.;
      const auto [rest, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (error != std::errc() || rest != cell.data() + cell.size() || !std::isfinite(value))
        return std::nullopt;
      return value;
    }

    /// As C writes numbers: typesetting has another minus, Fortran another exponent (1.5D-04).
    std::string as_in_c(const std::string_view cell)
    {
      std::string text;
      for (std::size_t i = 0; i < cell.size(); ++i)
        if (cell.substr(i, true_minus.size()) == true_minus)
        {
          text += '-';
          i += true_minus.size() - 1;
        }
        else
          text += cell[i] == 'D' && i > 0 && i + 1 < cell.size() ? 'E' : cell[i];
      return text;
    }

    bool is_number_with(const char mark, const std::string_view cell)
    {
      if (std::count(cell.begin(), cell.end(), mark) != 1)
        return false;
      std::string text = as_in_c(cell);
      std::replace(text.begin(), text.end(), mark, '.');
      return parse_with_point(text).has_value();
    }

    /// One to three digits, a mark, three digits: 1,234.
    bool is_group(const char mark, std::string_view cell)
    {
      if (cell.starts_with('-') || cell.starts_with('+'))
        cell.remove_prefix(1);
      const auto at = cell.find(mark);
      return at >= 1 && at <= 3 && cell.size() == at + 4 && cell.front() != '0' &&
             std::all_of(cell.begin(), cell.end(), [mark](const char c) { return c == mark || is_digit(c); });
    }
  } // namespace

  void MarkEvidence::look_at(const std::string_view cell)
  {
    const bool has_point = cell.find('.') != std::string_view::npos,
               has_comma = cell.find(',') != std::string_view::npos;
    if (has_point == has_comma)
      return;
    const char mark = has_point ? '.' : ',';
    if (!is_number_with(mark, cell))
      return;
    if (is_group(mark, cell))
      ++(has_point ? n_point_groups : n_comma_groups);
    else
      ++(has_point ? n_points : n_commas);
  }

  MarkEvidence &MarkEvidence::operator+=(const MarkEvidence &other)
  {
    n_points += other.n_points;
    n_commas += other.n_commas;
    n_point_groups += other.n_point_groups;
    n_comma_groups += other.n_comma_groups;
    return *this;
  }

  DecimalMark find_decimal_mark(const MarkEvidence &column, const MarkEvidence &table, const char separator)
  {
    if (table.n_commas + table.n_comma_groups == 0)
      return separator == ';' && table.n_points == 0 && column.n_point_groups > 0 ? DecimalMark::uncertain
                                                                                  : DecimalMark::point;
    const bool has_points = column.n_points + column.n_point_groups > 0;
    if (column.n_commas + column.n_comma_groups > 0)
    {
      const bool certain = column.n_commas > 0 || table.n_commas > 0;
      const bool foreign = table.n_points > 0 && (separator == ',' || column.n_commas == 0);
      return certain && !foreign && !has_points ? DecimalMark::comma : DecimalMark::uncertain;
    }
    return has_points && column.n_points == 0 && table.n_commas > 0 ? DecimalMark::uncertain : DecimalMark::point;
  }

  std::optional<double> parse_number(const std::string_view cell, const DecimalMark mark)
  {
    const bool has_point = cell.find('.') != std::string_view::npos,
               has_comma = cell.find(',') != std::string_view::npos;
    if ((has_comma && mark != DecimalMark::comma) || (has_point && mark == DecimalMark::comma) ||
        (mark == DecimalMark::uncertain && is_group('.', cell)))
      return std::nullopt;
    if (const std::optional<double> value = has_comma ? std::nullopt : parse_with_point(cell))
      return value;
    if (cell.empty() || (!is_digit(cell.back()) && cell.back() != ',' && cell.back() != '.'))
      return std::nullopt;
    std::string text = as_in_c(cell);
    std::replace(text.begin(), text.end(), ',', '.');
    return std::count(text.begin(), text.end(), '.') > 1 ? std::nullopt : parse_with_point(text);
  }

  std::string remedy_for_number(const std::string_view cell, const DecimalMark mark)
  {
    if (cell.size() > 1 && cell.find_first_not_of('#') == std::string_view::npos)
      return "a spreadsheet writes # where a column is too narrow: make it wider and save the table again";
    const auto n_points = std::count(cell.begin(), cell.end(), '.'),
               n_commas = std::count(cell.begin(), cell.end(), ',');
    const bool starts_like_a_number =
        !cell.empty() && is_digit(cell.find_first_of("+-") == 0 && cell.size() > 1 ? cell[1] : cell[0]);
    if (starts_like_a_number && n_points + n_commas > 1)
      return "write it without separators between thousands";
    if (is_group(',', cell) || is_group('.', cell))
      return "its mark may stand between thousands or before decimals: write 1234 or 1.2340 for a number like 1,234 or "
             "1.234";
    if (is_number_with(',', cell) && mark != DecimalMark::comma)
      return "other cells have decimal points: write all numbers of the table with one decimal mark";
    if (starts_like_a_number && std::any_of(cell.begin(), cell.end(), [](const unsigned char c) {
          return c == ' ' || c >= 0x80 || c == '%' || (std::isalpha(c) && c != 'e' && c != 'E');
        }))
      return "write the number alone, without unit or blanks (the unit stands in the name of the column)";
    return "correct it, or leave the row out";
  }
} // namespace swimtwin
