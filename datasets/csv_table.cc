#include <datasets/csv_table.h>
#include <datasets/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::string trim(const std::string &text)
    {
      const char *blanks = " \t\r";
      const auto  first  = text.find_first_not_of(blanks);
      return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
    }

    /// Where the cell that starts at `begin` ends: at the next comma outside double quotes, or at the end.
    std::size_t end_of_cell(const std::string &line, const std::size_t begin)
    {
      bool quoted = false;
      for (std::size_t i = begin; i < line.size(); ++i)
      {
        quoted ^= line[i] == '"';
        if (line[i] == ',' && !quoted)
          return i;
      }
      return line.size();
    }

    std::string without_quotes(const std::string &cell)
    {
      const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
      return quoted ? trim(cell.substr(1, cell.size() - 2)) : cell;
    }

    std::vector<std::string> split_cells(const std::string &line)
    {
      std::vector<std::string> cells;
      for (std::size_t begin = 0; begin <= line.size(); begin = end_of_cell(line, begin) + 1)
        cells.push_back(without_quotes(trim(line.substr(begin, end_of_cell(line, begin) - begin))));
      return cells;
    }

    std::optional<double> parse_number(const std::string &cell)
    {
      double      value = 0.;
      const char *begin = cell.data() + (cell.starts_with('+') ? 1 : 0), *end = cell.data() + cell.size();
      const auto [rest, error] = std::from_chars(begin, end, value);
      if (error != std::errc() || rest != end || !std::isfinite(value))
        return std::nullopt;
      return value;
    }
  } // namespace

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
    CsvTable           table;
    std::istringstream stream(read_text_file(file, "the table"));
    table.file_      = file.string();
    std::size_t line = 0;
    for (std::string text; std::getline(stream, text);)
    {
      ++line;
      if (line == 1 && text.starts_with("\xEF\xBB\xBF"))
        text.erase(0, 3); // byte order mark
      const std::string content = trim(text);
      if (content.empty() || content.starts_with('#'))
        continue;
      Row row{line, split_cells(content)};
      if (table.header_.empty())
      {
        table.header_      = row.cells;
        table.header_line_ = line;
        continue;
      }
      if (row.cells.size() == table.header_.size())
        table.rows_.push_back(std::move(row));
      else
        left_out.push_back(fmt::format("{}:{}: this row has {} values but the header names {} columns.", table.file_,
                                       line, row.cells.size(), table.header_.size()));
    }
    if (table.header_.empty())
      throw InputError(fmt::format("{}:1: the file is empty; a header line of column names is needed.", table.file_));
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

  std::optional<double> CsvTable::number(const std::size_t row, const std::string &name) const
  {
    return parse_number(rows_.at(row).cells[require_column(name)]);
  }

  std::string CsvTable::quote(const std::size_t row, const std::string &name) const
  {
    const std::size_t index = require_column(name);
    return fmt::format("{} (column {}) = \"{}\"", name, index + 1, rows_.at(row).cells[index]);
  }

  std::vector<double> CsvTable::column(const std::string &name) const
  {
    const std::size_t   index = require_column(name);
    std::vector<double> values;
    values.reserve(rows_.size());
    for (const Row &row : rows_)
    {
      const std::optional<double> value = parse_number(row.cells[index]);
      if (!value)
        throw InputError(
            fmt::format("{}:{}: {} = \"{}\" is not a finite number.", file_, row.line, name, row.cells[index]));
      values.push_back(*value);
    }
    return values;
  }
} // namespace swimtwin
