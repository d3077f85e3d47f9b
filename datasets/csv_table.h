// A CSV file of numbers: a header line of column names, then one row per line.
#pragma once

#include <datasets/input_file.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Empty lines and lines that start with `#` are skipped; cells are trimmed, and may stand in double quotes.
  class CsvTable
  {
  public:
    /// Throws InputError naming the file when it cannot be read, has no header, or (with the line) has a row of another
    /// length than the header.
    static CsvTable read(const std::filesystem::path &file);
    /// The same for a linter: rows of another length are left out, with a sentence each added to `left_out`.
    static CsvTable read(const std::filesystem::path &file, std::vector<std::string> &left_out);

    const std::vector<std::string> &column_names() const { return header_; }
    /// A row as it stands in the file, one text per column.
    const std::vector<std::string> &cells(std::size_t row) const { return rows_.at(row).cells; }

    std::size_t n_rows() const { return rows_.size(); }
    bool        has_column(const std::string &name) const;
    /// The number of a cell, or none where it is not a finite one; InputError for a missing column.
    std::optional<double> number(std::size_t row, const std::string &name) const;
    /// `name (column 3) = "cell"`, for a sentence about a cell; InputError for a missing column.
    std::string quote(std::size_t row, const std::string &name) const;
    /// The numbers of a column; InputError for a missing column and for a cell that is not a finite number.
    std::vector<double> column(const std::string &name) const;
    /// `file:line` of a row, or of the header.
    std::string where(std::size_t row) const;
    std::string where_header() const;
    std::size_t line(std::size_t row) const { return rows_.at(row).line; }

  private:
    struct Row
    {
      std::size_t              line = 0;
      std::vector<std::string> cells;
    };

    std::optional<std::size_t> find_column(const std::string &name) const;
    std::size_t                require_column(const std::string &name) const;

    std::string              file_;
    std::size_t              header_line_ = 0;
    std::vector<std::string> header_;
    std::vector<Row>         rows_;
  };
} // namespace swimtwin
