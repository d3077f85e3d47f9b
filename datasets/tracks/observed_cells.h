// Columns of measured numbers, checked cell by cell.
#pragma once

#include <datasets/text/csv_table.h>
#include <datasets/tracks/data_problems.h>

#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  /// What is wrong with cells of a column, and so with their rows: one sentence for each kind of fault, with the lines
  /// where it is.
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
      std::string              remedy;
      std::vector<std::size_t> rows;
      std::vector<std::string> faults; ///< of the rows
    };

    std::string sentence(const Kind &kind, std::size_t i, const std::string &others) const;

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

  /// Whether a row below the names holds their units: noted in one sentence for all of its cells.
  bool has_row_of_units(const CsvTable &table, DataProblems &problems);

  /// The cells of some rows times `factor`; those that are no finite numbers are noted and left out.
  std::vector<double> scaled_cells(const CsvTable &table, std::size_t column, const std::vector<std::size_t> &rows,
                                   double factor, DataProblems &problems);

  /// Note the rows at which times (of these rows, in s; any number of them) do not come after those before. Where one
  /// clock that leapt ahead would make all that follows wrong, the fewest rows are noted that let the others increase.
  void require_increasing(const CsvTable &table, std::size_t column, const std::vector<std::size_t> &rows,
                          const std::vector<double> &time_s, DataProblems &problems);

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
