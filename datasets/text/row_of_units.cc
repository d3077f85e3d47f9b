#include <datasets/text/row_of_units.h>
#include <datasets/text/unit_names.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    std::string remedy_for_contradiction(const std::string &name, const std::string &unit)
    {
      return fmt::format("this row says that {} is in {}: if so, name that column {}, else correct the row; then leave "
                         "the row out",
                         name, without_brackets(unit), name_in_unit(name, unit));
    }
  } // namespace

  std::optional<RowOfUnits> find_row_of_units(const std::vector<std::string> &names,
                                              const std::vector<std::string> &cells)
  {
    std::optional<RowOfUnits> row;
    for (std::size_t column = 0; column < std::min(names.size(), cells.size()); ++column)
    {
      const auto reading = reading_with_unit(names[column]);
      if (!reading || cells[column].empty())
        continue;
      const std::optional<double> factor = unit_factor(cells[column], reading->unit);
      if (!factor)
        return std::nullopt;
      if (!row)
        row = RowOfUnits{false, "this row holds units, which stand in the names of the columns: leave it out"};
      if (std::abs(*factor - 1.) > 1e-12 && !row->contradicts_a_name)
        row = RowOfUnits{true, remedy_for_contradiction(names[column], cells[column])};
    }
    return row;
  }
} // namespace swimtwin
