#include <datasets/nearest_name.h>
#include <datasets/observed_cells.h>
#include <datasets/toml_table.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    std::string remedy_for_header(const CsvTable &table, const std::string &column, const std::string_view unit)
    {
      const std::vector<std::string> &names = table.column_names();
      if (names.size() == 1 && names.front().find_first_of(";\t") != std::string::npos)
        return "save the table with commas between the columns";
      return fmt::format("add it ({}), or rename the column that holds it (nearest name: {})", unit,
                         nearest_name(column, names));
    }

    std::vector<double> checked_cells(const CsvTable &table, const std::string &column, const std::string_view unit,
                                      DataProblems &problems, const std::string_view remedy_if_not_positive)
    {
      if (!table.has_column(column))
      {
        problems.error(fmt::format("{}: the column {} is missing; {}.", table.where_header(), column,
                                   remedy_for_header(table, column, unit)));
        return {};
      }
      std::vector<double> values;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
      {
        const std::optional<double> value = table.number(row, column);
        const std::string           cell  = fmt::format("{}: {}", table.where(row), table.quote(row, column));
        if (!value)
          problems.error(fmt::format("{} is not a finite number; correct it, or leave the row out.", cell));
        else if (!remedy_if_not_positive.empty() && *value <= 0.)
          problems.error(fmt::format("{} is not positive; {}.", cell, remedy_if_not_positive));
        else
          values.push_back(*value);
      }
      return values.size() == table.n_rows() ? values : std::vector<double>();
    }
  } // namespace

  std::vector<double> finite_cells(const CsvTable &table, const std::string &column, const std::string_view unit,
                                   DataProblems &problems)
  {
    return checked_cells(table, column, unit, problems, "");
  }

  std::vector<double> positive_cells(const CsvTable &table, const std::string &column, const std::string_view remedy,
                                     DataProblems &problems)
  {
    return checked_cells(table, column, remedy, problems, remedy);
  }
} // namespace swimtwin
