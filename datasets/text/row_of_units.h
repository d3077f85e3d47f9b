// A row below the names of columns that says their units, as plotting programs write it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What to do about such a row; none if it is no row of units. Where the unit of a cell is another one than that in
  /// the name of its column (`cm` below `displacement_m`), leaving the row out would make numbers wrong.
  struct RowOfUnits
  {
    bool        contradicts_a_name = false;
    std::string remedy;
  };

  std::optional<RowOfUnits> find_row_of_units(const std::vector<std::string> &names,
                                              const std::vector<std::string> &cells);
} // namespace swimtwin
