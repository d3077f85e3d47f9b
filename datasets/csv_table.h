// A CSV file of numbers: a header line of column names, then one row per line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Empty lines and lines that start with `#` are skipped; cells are trimmed.
  class CsvTable
  {
  public:
    /// Throws InputError naming the file when it cannot be read, has no header, or (with the line) has a row of another
    /// length than the header.
    static CsvTable read(const std::filesystem::path &file);

    const std::vector<std::string> &column_names() const { return header_; }
    /// A row as it stands in the file, one text per column.
    const std::vector<std::string> &cells(std::size_t row) const { return rows_.at(row).cells; }

    std::size_t n_rows() const { return rows_.size(); }
    bool        has_column(const std::string &name) const;
    /// The numbers of a column; InputError for a missing column and for a cell that is not a finite number.
    std::vector<double> column(const std::string &name) const;
    /// `file:line` of a row.
    std::string where(std::size_t row) const;

  private:
    struct Row
    {
      std::size_t              line = 0;
      std::vector<std::string> cells;
    };

    std::optional<std::size_t> find_column(const std::string &name) const;

    std::string              file_;
    std::size_t              header_line_ = 0;
    std::vector<std::string> header_;
    std::vector<Row>         rows_;
  };

  /// Content of a file; InputError `cannot read X: <cause>` names it as `what` ("the scene", ...).
  std::string read_text_file(const std::filesystem::path &file, const std::string &what);
} // namespace swimtwin
