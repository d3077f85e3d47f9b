#include <datasets/system/error.h>
#include <datasets/text/csv_table.h>
#include <datasets/text/delimited_text.h>
#include <datasets/text/foreign_format.h>
#include <datasets/text/row_of_units.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/text_line.h>
#include <datasets/text/unit_names.h>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace swimtwin
{
  namespace
  {
    bool is_empty(const std::string &cell)
    {
      return cell.empty();
    }

    bool are_empty(const std::vector<std::string> &cells, const std::size_t from = 0)
    {
      return std::all_of(cells.begin() + static_cast<std::ptrdiff_t>(std::min(from, cells.size())), cells.end(),
                         is_empty);
    }

    /// As R writes a row: its name in quotes, and numbers behind it without.
    bool begins_with_a_row_name(const std::string_view row)
    {
      const auto begin = row.find_first_not_of(' ');
      if (begin == std::string_view::npos || row[begin] != '"')
        return false;
      const auto next = row.find_first_not_of(" \t;,|", std::min(row.find('"', begin + 1), row.size() - 1) + 1);
      return next != std::string_view::npos && row[next] != '"';
    }

    /// What to do about rows of another length.
    std::string remedy_for_length(const std::size_t n_header, const std::string &text, const char separator)
    {
      const std::size_t n_cells = split_cells(text, separator).size();
      if (n_header == 1 && n_cells > 1)
        return "if the header is a title, delete it or put # before it; column names are needed above the rows";
      if (separator == ',' && n_cells > n_header)
        return "give one value per column, or save the table with semicolons or tabs between the columns if these are "
               "decimal commas";
      for (const char other : {';', '\t'})
        if (n_cells == 1 && split_cells(text, other).size() > 1)
          return "separate the rows like the header";
      return "give one value per column";
    }
  } // namespace

  std::string and_others(const std::vector<std::size_t> &lines)
  {
    constexpr std::size_t most = 5;
    if (lines.size() < 2)
      return "";
    const std::size_t n = std::min(lines.size(), most);
    return fmt::format(" ({} rows: lines {}{})", lines.size(),
                       fmt::join(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(n), ", "),
                       n < lines.size() ? ", ..." : "");
  }

  CsvTable CsvTable::read(const std::filesystem::path &file)
  {
    std::vector<std::string> problems;
    CsvTable                 table = read(file, problems);
    if (!problems.empty())
      throw InputError(problems.front());
    return table;
  }

  CsvTable CsvTable::read(const std::filesystem::path &file, std::vector<std::string> &left_out)
  {
    CsvTable          table;
    const std::string bytes = read_content(file, "the table");
    refuse_foreign_table(file, bytes);
    table.file_              = file.string();
    const DelimitedText text = split_rows(decoded_text(bytes, file), table.file_);
    if (text.rows.empty())
      throw InputError(fmt::format("{}:1: the file is empty; a header line of column names is needed.", table.file_));
    table.header_      = split_cells(text.rows.front().text, text.separator);
    table.header_line_ = text.rows.front().line;
    for (std::size_t i = 1; i < text.rows.size(); ++i)
      if (Row row{text.rows[i].line, split_cells(text.rows[i].text, text.separator),
                  begins_with_a_row_name(text.rows[i].text)};
          !are_empty(row.cells) && row.cells != table.header_)
        table.rows_.push_back(std::move(row));
    table.refuse_title();
    table.name_row_numbers();
    table.place_.resize(table.header_.size());
    std::iota(table.place_.begin(), table.place_.end(), std::size_t(1));
    table.fit_lengths(text.separator, left_out);
    table.drop_nameless_columns();
    table.find_decimal_marks(text.separator);
    return table;
  }

  /// Whether each row has one cell more than the header, and the first ones count the rows.
  bool CsvTable::has_nameless_count() const
  {
    const auto number = [&](const std::size_t row) {
      return parse_number(rows_[row].cells.front(), DecimalMark::point);
    };
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (rows_[i].cells.size() != header_.size() + 1 || rows_[i].cells.back().empty() || !number(i) ||
          (*number(0) != 0. && *number(0) != 1.) || *number(i) != *number(0) + static_cast<double>(i))
        return false;
    return rows_.size() > 1 && !header_.front().empty();
  }

  /// R names the rows without a name for that column. Numbers that are not in quotes may be those of the first column
  /// as well, and then it is the last one that has no name.
  void CsvTable::name_row_numbers()
  {
    if (!has_nameless_count())
      return;
    if (!std::all_of(rows_.begin(), rows_.end(), [](const Row &row) { return row.has_row_name; }))
      throw InputError(fmt::format("{}: the header names {} columns but the rows have {} values, and {}, {}, ... may "
                                   "number the rows or be {} beside a last column without a name; name the column of "
                                   "row numbers too (row), or delete the one without a name.",
                                   where_header(), header_.size(), header_.size() + 1, rows_[0].cells.front(),
                                   rows_[1].cells.front(), header_.front()));
    header_.insert(header_.begin(), "");
  }

  /// A title has another length than the rows, of which the first names their columns.
  void CsvTable::refuse_title() const
  {
    const auto is_number = [](const std::string &cell) { return parse_number(cell, DecimalMark::point).has_value(); };
    if (rows_.size() < 2 || rows_.front().cells.size() < 2 ||
        std::any_of(rows_.front().cells.begin(), rows_.front().cells.end(), is_number))
      return;
    const std::size_t n = rows_.front().cells.size();
    if (n != header_.size() && (n > header_.size() || !are_empty(header_, n)) &&
        std::all_of(rows_.begin(), rows_.end(), [n](const Row &row) { return row.cells.size() == n; }))
      throw InputError(fmt::format("{}: this line has {} value(s) but every row below it {}, and line {} names the "
                                   "columns: if it is a title, delete it or put # before it.",
                                   where_header(), header_.size(), n, rows_.front().line));
  }

  /// Empty cells behind the last column go, nameless ones that are left out come back; other rows are left out.
  void CsvTable::fit_lengths(const char separator, std::vector<std::string> &left_out)
  {
    const std::size_t        n = header_.size();
    std::vector<std::size_t> lines;
    std::vector<Row>         fitting;
    const auto               sentence = [&](const Row &row, const std::string &others) {
      return fmt::format(
                        "{}:{}: this row has {} values but the header names {} columns{}; {}.", file_, row.line, row.cells.size(), n,
                        others, remedy_for_length(n, fmt::format("{}", fmt::join(row.cells, std::string(1, separator))), separator));
    };
    std::optional<Row> first;
    for (Row &row : rows_)
      if (row.cells.size() == n ||
          (row.cells.size() > n ? are_empty(row.cells, n) : are_empty(header_, row.cells.size())))
      {
        row.cells.resize(n);
        fitting.push_back(std::move(row));
      }
      else
      {
        lines.push_back(row.line);
        left_out_.push_back({row.line, sentence(row, "")});
        if (!first)
          first = std::move(row);
      }
    if (first)
      left_out.push_back(sentence(*first, and_others(lines)));
    rows_ = std::move(fitting);
  }

  void CsvTable::drop_nameless_columns()
  {
    for (std::size_t column = header_.size(); column-- > 0;)
      if (header_[column].empty() &&
          std::all_of(rows_.begin(), rows_.end(), [&](const Row &row) { return row.cells[column].empty(); }))
      {
        const auto at = static_cast<std::ptrdiff_t>(column);
        header_.erase(header_.begin() + at);
        place_.erase(place_.begin() + at);
        for (Row &row : rows_)
          row.cells.erase(row.cells.begin() + at);
      }
  }

  void CsvTable::find_decimal_marks(const char separator)
  {
    std::vector<MarkEvidence> columns(header_.size());
    MarkEvidence              all;
    for (const Row &row : rows_)
      for (std::size_t column = 0; column < columns.size(); ++column)
        columns[column].look_at(row.cells[column]);
    for (const MarkEvidence &column : columns)
      all += column;
    for (const MarkEvidence &column : columns)
      marks_.push_back(find_decimal_mark(column, all, separator));
  }

  CsvTable CsvTable::without(const std::vector<WrongRow> &rows) const
  {
    std::set<std::size_t> lines;
    for (const WrongRow &row : rows)
      lines.insert(row.line);
    CsvTable table = *this;
    std::erase_if(table.rows_, [&](const Row &row) { return lines.contains(row.line); });
    return table;
  }

  CsvTable CsvTable::with_units_in_names() const
  {
    if (rows_.empty())
      return *this;
    CsvTable table = *this;
    for (std::size_t column = 0; column < header_.size(); ++column)
    {
      const std::string &name = header_[column], &unit = rows_.front().cells[column];
      if (name.empty() || unit.empty())
        continue;
      if (reading_with_unit(name) || !unit_factor(unit, unit))
        return *this;
      table.header_[column] = name_in_unit(name, unit);
    }
    if (table.header_ == header_)
      return *this;
    table.rows_.erase(table.rows_.begin());
    return table;
  }

  std::optional<std::size_t> CsvTable::find_column(const std::string &name) const
  {
    const auto found = std::find(header_.begin(), header_.end(), name);
    if (found == header_.end())
      return std::nullopt;
    return static_cast<std::size_t>(found - header_.begin());
  }

  bool CsvTable::has_column(const std::string &name) const
  {
    return find_column(name).has_value();
  }

  std::size_t CsvTable::require_column(const std::string &name) const
  {
    if (const std::optional<std::size_t> index = find_column(name))
      return *index;
    for (const std::string &other : header_)
      if (const std::optional<double> factor = factor_between_names(other, name))
        throw InputError(fmt::format("{}: the column {} is missing; multiply {} by {:.6g} and name it {}.",
                                     where_header(), name, other, *factor, name));
    throw InputError(
        fmt::format("{}: the column {} is missing; the header has {}.", where_header(), name, fmt::join(header_, ",")));
  }

  std::string CsvTable::where(const std::size_t row) const
  {
    return row < rows_.size() ? fmt::format("{}:{}", file_, rows_[row].line) : where_header();
  }

  std::string CsvTable::where_header() const
  {
    return fmt::format("{}:{}", file_, header_line_);
  }

  std::vector<std::size_t> CsvTable::lines(const std::vector<std::size_t> &rows) const
  {
    std::vector<std::size_t> found;
    for (const std::size_t row : rows)
      found.push_back(line(row));
    return found;
  }

  std::optional<double> CsvTable::number(const std::size_t row, const std::string &name) const
  {
    return number(row, require_column(name));
  }

  std::optional<double> CsvTable::number(const std::size_t row, const std::size_t column) const
  {
    return parse_number(rows_.at(row).cells.at(column), marks_.at(column));
  }

  std::string CsvTable::quote(const std::size_t row, const std::string &name) const
  {
    return quote(row, require_column(name));
  }

  std::string CsvTable::quote(const std::size_t row, const std::size_t column) const
  {
    return fmt::format("{} (column {}) = \"{}\"", header_.at(column), place_.at(column),
                       shortened(rows_.at(row).cells.at(column)));
  }

  std::string CsvTable::remedy(const std::size_t row, const std::size_t column) const
  {
    if (const auto units = find_row_of_units(header_, rows_.at(row).cells))
      return units->remedy;
    return remedy_for_number(rows_.at(row).cells.at(column), marks_.at(column));
  }

  std::vector<double> CsvTable::column(const std::string &name) const
  {
    const std::size_t   index = require_column(name);
    std::vector<double> values;
    values.reserve(rows_.size());
    for (std::size_t row = 0; row < rows_.size(); ++row)
    {
      const std::optional<double> value = number(row, index);
      if (!value)
        throw InputError(fmt::format("{}: {} = \"{}\" is not a finite number; {}.", where(row), name,
                                     shortened(rows_[row].cells[index]), remedy(row, index)));
      values.push_back(*value);
    }
    return values;
  }
} // namespace swimtwin
