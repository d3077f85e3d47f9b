// Columns of measured numbers, checked cell by cell.
#pragma once

#include <datasets/text/csv_table.h>
#include <datasets/tracks/data_problems.h>

#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  /// What is wrong with cells of a column: one sentence for each kind of fault, with the lines where it is.
  class CellFaults
  {
  public:
    CellFaults(const CsvTable &table, const std::size_t column) : table_(table), column_(column) {}

    /// `fault` completes the quoted cell ("is not positive"); cells with the same remedy are of one kind.
    void add(std::size_t row, const std::string &fault, const std::string &remedy);
    /// The cell has no finite number.
    void add_no_number(std::size_t row);
    void note(DataProblems &problems) const;

  private:
    struct Kind
    {
      std::string              fault, remedy;
      std::vector<std::size_t> rows;
    };

    const CsvTable   &table_;
    std::size_t       column_;
    std::vector<Kind> kinds_;
  };

  /// A column of a quantity, and what its numbers are multiplied with.
  struct QuantityColumn
  {
    std::size_t index  = 0;
    double      factor = 1.;
  };

  /// The column of that name (`displacement_m`), or the only one that says the same in another unit (`displacement_mm`,
  /// `Displacement (µm)`).
  std::optional<QuantityColumn> find_quantity(const CsvTable &table, const std::string &column);

  /// Whether the first row names columns at all; else the one thing to say is noted: it holds numbers, or the names
  /// stand further down. `columns` are the wanted ones.
  bool has_names(const CsvTable &table, const std::vector<std::string> &columns, DataProblems &problems);

  /// The cells of some rows times `factor`; those that are no finite numbers are noted and left out.
  std::vector<double> scaled_cells(const CsvTable &table, std::size_t column, const std::vector<std::size_t> &rows,
                                   double factor, DataProblems &problems);

  /// The numbers of a column in the unit of its name, as many as rows; empty if a problem was noted: the column is
  /// missing (`unit` says what it holds), or a cell is not a finite number. A column in another unit is converted.
  std::vector<double> finite_cells(const CsvTable &table, const std::string &column, std::string_view unit,
                                   DataProblems &problems);
  /// One sentence about the columns among these that are converted, if any are.
  void warn_of_conversions(const CsvTable &table, const std::vector<std::string> &columns, DataProblems &problems);

  /// The same, for numbers that must be positive; `remedy` completes "... is not positive; ".
  std::vector<double> positive_cells(const CsvTable &table, const std::string &column, std::string_view remedy,
                                     DataProblems &problems);
} // namespace swimtwin
