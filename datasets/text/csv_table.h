// A file of numbers in columns: a header line of column names, then one row per line.
#pragma once

#include <datasets/files/input_file.h>
#include <datasets/text/number_text.h>
#include <datasets/text/wrong_row.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// As this program writes it, or another one: the separator, the decimal mark, the encoding and the line ends are
  /// found out where they are certain (docs/file-formats.md, Tables of other programs). Empty rows and lines that start
  /// with
  /// `#` are skipped, and so are empty columns without a name and a repeated header; cells are trimmed, and may stand
  /// in double quotes.
  class CsvTable
  {
  public:
    /// Throws InputError naming the file when it cannot be read, is no text, has no header, or (with the line) has a
    /// row of another length than the header.
    static CsvTable read(const std::filesystem::path &file);
    /// The same for a linter: rows of another length are left out, with one sentence about all of them in `left_out`.
    static CsvTable read(const std::filesystem::path &file, std::vector<std::string> &left_out);

    const std::vector<std::string> &column_names() const { return header_; }
    /// A row as it stands in the file, one text per column.
    const std::vector<std::string> &cells(std::size_t row) const { return rows_.at(row).cells; }

    std::size_t n_rows() const { return rows_.size(); }
    /// Rows of another length than the header, of a table that was read without them.
    const std::vector<WrongRow> &left_out() const { return left_out_; }
    /// The table without the rows on these lines of its file.
    CsvTable without(const std::vector<WrongRow> &rows) const;
    /// Where no name says a unit and the first row holds nothing but units (`frequency,displacement`, then `Hz,cm`),
    /// the table with these in its names and without that row.
    CsvTable                   with_units_in_names() const;
    bool                       has_column(const std::string &name) const;
    std::optional<std::size_t> find_column(const std::string &name) const;
    /// The number of a cell, or none where it is not a finite one; InputError for a missing column.
    std::optional<double> number(std::size_t row, const std::string &name) const;
    std::optional<double> number(std::size_t row, std::size_t column) const;
    /// `name (column 3) = "cell"`, for a sentence about a cell, of which a long one is cut; InputError for a missing
    /// column.
    std::string quote(std::size_t row, const std::string &name) const;
    std::string quote(std::size_t row, std::size_t column) const;
    /// What to do about a cell without a number.
    std::string remedy(std::size_t row, std::size_t column) const;
    /// The numbers of a column; InputError for a missing column and for a cell that is not a finite number.
    std::vector<double> column(const std::string &name) const;
    /// `file:line` of a row, or of the header.
    std::string              where(std::size_t row) const;
    std::string              where_header() const;
    std::size_t              line(std::size_t row) const { return rows_.at(row).line; }
    std::vector<std::size_t> lines(const std::vector<std::size_t> &rows) const;
    const std::string       &file() const { return file_; }

  private:
    struct Row
    {
      std::size_t              line = 0;
      std::vector<std::string> cells;
      bool                     has_row_name = false; ///< in quotes, as R writes it
    };

    std::size_t require_column(const std::string &name) const;
    void        refuse_title() const;
    bool        has_nameless_count() const;
    void        name_row_numbers();
    void        fit_lengths(char separator, std::vector<std::string> &left_out);
    void        drop_nameless_columns();
    void        find_decimal_marks(char separator);

    std::string              file_;
    std::size_t              header_line_ = 0;
    std::vector<WrongRow>    left_out_;
    std::vector<std::string> header_;
    std::vector<std::size_t> place_; ///< of each column in the file
    std::vector<DecimalMark> marks_; ///< of each column
    std::vector<Row>         rows_;
  };

  /// ` (3 rows: lines 4, 7, 12)` of several rows of a table, at most five of them; empty for one.
  std::string and_others(const std::vector<std::size_t> &lines);
} // namespace swimtwin
