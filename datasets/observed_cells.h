// Columns of measured numbers, checked cell by cell.
#pragma once

#include <datasets/csv_table.h>
#include <datasets/data_problems.h>

#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  /// The numbers of a column, as many as rows; empty if a problem was noted: the column is missing (`unit` says what it
  /// holds), or a cell is not a finite number.
  std::vector<double> finite_cells(const CsvTable &table, const std::string &column, std::string_view unit,
                                   DataProblems &problems);
  /// The same, for numbers that must be positive; `remedy` completes "... is not positive; ".
  std::vector<double> positive_cells(const CsvTable &table, const std::string &column, std::string_view remedy,
                                     DataProblems &problems);
} // namespace swimtwin
