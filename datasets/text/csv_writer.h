// A table as spreadsheets, pandas and gnuplot open it: a header line of column names, then one line per row, and
// nothing else. Where a table came from stands in the JSON file beside it.
#pragma once

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  class CsvWriter
  {
  public:
    /// The names must differ.
    explicit CsvWriter(const std::vector<std::string> &column_names);

    /// In the shortest form that reads back as the same double; empty if it is not finite.
    CsvWriter &cell(double value);
    CsvWriter &cell(const std::optional<double> &value) { return value ? cell(*value) : word(""); }
    template <std::integral Type>
    CsvWriter &cell(const Type value)
    {
      return word(std::to_string(value));
    }
    /// In double quotes where separators, quotes or the blanks at its ends ask for them. A row must stay a line of
    /// text: line breaks and other control characters become blanks, bytes that are not UTF-8 the sign for that.
    CsvWriter &cell(const std::string &text);
    /// Every row has a cell for every column.
    void end_row();

    std::size_t        n_rows() const { return n_rows_; }
    const std::string &text() const { return text_; }
    /// To a temporary name, then renamed; ComputationError names the file and the cause.
    void save(const std::filesystem::path &file) const;

  private:
    CsvWriter &word(const std::string &characters);

    std::string text_;
    std::size_t n_columns_ = 0, n_rows_ = 0, n_cells_ = 0;
  };

  /// A column of numbers, one for each row.
  template <typename Row>
  struct CsvColumn
  {
    std::string                        name;
    std::function<double(const Row &)> value;
  };

  template <typename Row>
  CsvWriter csv_table(const std::vector<CsvColumn<Row>> &columns, const std::vector<Row> &rows)
  {
    std::vector<std::string> names;
    for (const CsvColumn<Row> &column : columns)
      names.push_back(column.name);
    CsvWriter table(names);
    for (const Row &row : rows)
    {
      for (const CsvColumn<Row> &column : columns)
        table.cell(column.value(row));
      table.end_row();
    }
    return table;
  }
} // namespace swimtwin
