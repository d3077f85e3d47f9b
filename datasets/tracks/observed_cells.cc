#include <datasets/system/nearest_name.h>
#include <datasets/text/row_of_units.h>
#include <datasets/text/toml_table.h>
#include <datasets/text/unit_names.h>
#include <datasets/tracks/observed_cells.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

namespace swimtwin
{
  namespace
  {
    bool is_number(const std::string &name)
    {
      return parse_number(name, DecimalMark::point) || parse_number(name, DecimalMark::comma);
    }

    /// The row that holds the name of a column below what was taken for the header.
    std::optional<std::size_t> find_row_of_names(const CsvTable &table, const std::string &column)
    {
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        for (const std::string &cell : table.cells(row))
          if (cell == column || factor_between_names(cell, column))
            return row;
      return std::nullopt;
    }

    /// A name of the right stem lacks a unit at all, or one that can be converted.
    std::string remedy_for_unit(const std::string &name, const std::string &unit, const std::string &column,
                                const std::string &wanted_unit)
    {
      if (unit.empty())
        return fmt::format("write the unit of \"{}\" into its name, as in {}; other units are converted", name, column);
      if (const auto repaired = repaired_unit(unit))
        return fmt::format(
            "name \"{}\", where the sign for micro was damaged on the way, {}, or save the table as UTF-8", name,
            name_in_unit(column, *repaired));
      return fmt::format("\"{}\" is in {}, whose size is not known here: compute the numbers in {} and name them {}",
                         name, unit, wanted_unit, column);
    }

    std::string remedy_for_unit(const std::vector<std::string> &names, const std::string &column)
    {
      for (const NameWithUnit &wanted : readings_of(column))
        if (!wanted.unit.empty() && unit_factor(wanted.unit, wanted.unit))
          for (const std::string &name : names)
            for (const NameWithUnit &reading : readings_of(name))
              if (reading.stem == wanted.stem)
                return remedy_for_unit(name, reading.unit, column, wanted.unit);
      return "";
    }

    constexpr std::array<const char *, 9> quantities{"frequency_Hz", "displacement_m", "sigma_m", "mean_speed_m_s",
                                                     "sigma_m_s",    "time_s",         "x_m",     "y_m",
                                                     "angle_rad"};

    /// Names that are not taken: those of no quantity that is known here.
    std::vector<std::string> free_names(const CsvTable &table)
    {
      std::vector<std::string> names = table.column_names();
      std::erase_if(names, [](const std::string &name) {
        return name.empty() || std::any_of(quantities.begin(), quantities.end(), [&](const char *quantity) {
                 return factor_between_names(name, quantity).has_value();
               });
      });
      return names;
    }

    /// Of the names, those in a unit that can be converted to that of the column.
    std::vector<std::string> names_in_units_of(const std::string &column, std::vector<std::string> names)
    {
      const auto wanted = reading_with_unit(column);
      std::erase_if(names, [&](const std::string &name) {
        const auto reading = reading_with_unit(name);
        return !wanted || !reading || !unit_factor(reading->unit, wanted->unit);
      });
      return names;
    }

    /// A column that says its unit keeps it.
    std::string remedy_for_header(const CsvTable &table, const std::string &column, const std::string_view unit)
    {
      if (const std::string remedy = remedy_for_unit(table.column_names(), column); !remedy.empty())
        return remedy;
      std::vector<std::string> names = free_names(table);
      if (const auto alike = names_in_units_of(column, names); !alike.empty())
      {
        const std::string nearest = nearest_name(column, alike);
        const std::string own     = name_in_unit(column, reading_with_unit(nearest)->unit);
        return fmt::format("add it ({}), or, if \"{}\" holds it, name that {}{}", unit, nearest, own,
                           own == column ? "" : ", which is converted");
      }
      std::erase_if(names, [](const std::string &name) { return reading_with_unit(name).has_value(); });
      if (names.empty())
        return fmt::format("add it ({})", unit);
      return fmt::format("add it ({}), or rename the column that holds it (nearest name: {}), with its unit", unit,
                         nearest_name(column, names));
    }

    std::vector<std::size_t> columns_in_other_units(const CsvTable &table, const std::string &column)
    {
      std::vector<std::size_t> found;
      const auto              &names = table.column_names();
      for (std::size_t i = 0; i < names.size(); ++i)
        if (factor_between_names(names[i], column))
          found.push_back(i);
      return found;
    }

    void note_missing(const CsvTable &table, const std::string &column, const std::string_view unit,
                      DataProblems &problems)
    {
      const std::vector<std::size_t> others = columns_in_other_units(table, column);
      const auto                    &names  = table.column_names();
      if (others.size() > 1)
        problems.error(
            fmt::format("{}: the column {} is missing, and \"{}\" and \"{}\" may both be it; keep one of them.",
                        table.where_header(), column, names[others[0]], names[others[1]]));
      else
        problems.error(fmt::format("{}: the column {} is missing; {}.", table.where_header(), column,
                                   remedy_for_header(table, column, unit)));
    }

    /// Those that do not come after the latest before them.
    std::vector<std::size_t> behind_earlier_ones(const std::vector<double> &time_s)
    {
      std::vector<std::size_t> behind;
      for (std::size_t i = 1, latest = 0; i < time_s.size(); ++i)
        if (time_s[i] > time_s[latest])
          latest = i;
        else
          behind.push_back(i);
      return behind;
    }

    /// All but a longest increasing subsequence (patience sorting).
    std::vector<std::size_t> fewest_out_of_order(const std::vector<double> &time_s)
    {
      constexpr std::size_t    none = std::numeric_limits<std::size_t>::max();
      std::vector<std::size_t> last_of_length, before(time_s.size(), none);
      for (std::size_t i = 0; i < time_s.size(); ++i)
      {
        const auto place = std::lower_bound(last_of_length.begin(), last_of_length.end(), time_s[i],
                                            [&](const std::size_t j, const double time) { return time_s[j] < time; });
        if (place != last_of_length.begin())
          before[i] = *std::prev(place);
        if (place == last_of_length.end())
          last_of_length.push_back(i);
        else if (time_s[i] < time_s[*place])
          *place = i;
      }
      std::vector<bool> is_kept(time_s.size());
      for (std::size_t i = last_of_length.empty() ? none : last_of_length.back(); i != none; i = before[i])
        is_kept[i] = true;
      std::vector<std::size_t> out;
      for (std::size_t i = 0; i < time_s.size(); ++i)
        if (!is_kept[i])
          out.push_back(i);
      return out;
    }

    /// Of the time `i`, one of those that are wrong.
    std::string fault_of_order(const std::vector<double> &time_s, const std::vector<std::size_t> &wrong,
                               const std::size_t i)
    {
      const auto is_wrong = [&](const std::size_t j) { return std::binary_search(wrong.begin(), wrong.end(), j); };
      for (std::size_t j = i; j-- > 0;)
        if (!is_wrong(j))
          return time_s[i] <= time_s[j] ? fmt::format("does not come after {} s", time_s[j])
                                        : "leaps ahead of those after it";
      return "leaps ahead of those after it";
    }

    std::vector<double> checked_cells(const CsvTable &table, const std::string &column, const std::string_view unit,
                                      DataProblems &problems, const std::string_view remedy_if_not_positive)
    {
      const std::optional<QuantityColumn> found = find_quantity(table, column);
      if (!found)
      {
        note_missing(table, column, unit, problems);
        return {};
      }
      CellFaults          faults(table, found->index);
      std::vector<double> values;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
      {
        const std::optional<double> value = table.number(row, found->index);
        if (!value)
          faults.add_no_number(row);
        else if (!remedy_if_not_positive.empty() && *value <= 0.)
          faults.add(row, "is not positive", std::string(remedy_if_not_positive));
        else
          values.push_back(*value * found->factor);
      }
      faults.note(problems);
      return values.size() == table.n_rows() ? values : std::vector<double>();
    }
  } // namespace

  bool has_names(const CsvTable &table, const std::vector<std::string> &columns, DataProblems &problems)
  {
    const std::vector<std::string> &names = table.column_names();
    if (std::all_of(names.begin(), names.end(), is_number))
    {
      problems.error(
          fmt::format("{}: the first row holds numbers; put a row of column names above it, without # in front: "
                      "{}.",
                      table.where_header(), fmt::join(columns, ",")));
      return false;
    }
    const auto is_there = [&](const std::string &column) { return find_quantity(table, column).has_value(); };
    if (std::any_of(columns.begin(), columns.end(), is_there))
      return true;
    for (const std::string &column : columns)
      if (const auto row = find_row_of_names(table, column))
      {
        problems.error(
            fmt::format("{}: this row names no column, but line {} does; delete the lines above that, or put # "
                        "before them.",
                        table.where_header(), table.line(*row)));
        return false;
      }
    if (std::all_of(names.begin(), names.end(),
                    [](const std::string &name) { return name.empty() || unit_factor(name, name); }))
    {
      problems.error(fmt::format("{}: this row holds units, not names; write them into the names below it, as in {}, "
                                 "and delete the row.",
                                 table.where_header(), fmt::join(columns, ",")));
      return false;
    }
    return true;
  }

  bool has_row_of_units(const CsvTable &table, DataProblems &problems)
  {
    for (std::size_t row = 0; row < table.n_rows(); ++row)
      if (const auto units = find_row_of_units(table.column_names(), table.cells(row)))
      {
        const std::string sentence = fmt::format("{}: {}.", table.where(row), units->remedy);
        problems.error(sentence, units->contradicts_a_name ? std::vector<WrongRow>()
                                                           : std::vector<WrongRow>{{table.line(row), sentence}});
        return true;
      }
    return false;
  }

  void CellFaults::add(const std::size_t row, const std::string &fault, const std::string &remedy)
  {
    const auto same = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind &k) { return k.remedy == remedy; });
    Kind      &kind = same == kinds_.end() ? kinds_.emplace_back(Kind{remedy, {}, {}}) : *same;
    kind.rows.push_back(row);
    kind.faults.push_back(fault);
  }

  void CellFaults::add_no_number(const std::size_t row)
  {
    add(row, "is not a finite number", table_.remedy(row, column_));
  }

  std::string CellFaults::sentence(const Kind &kind, const std::size_t i, const std::string &others) const
  {
    return fmt::format("{}: {} {}{}; {}.", table_.where(kind.rows[i]), table_.quote(kind.rows[i], column_),
                       kind.faults[i], others, kind.remedy);
  }

  void CellFaults::note(DataProblems &problems) const
  {
    for (const Kind &kind : kinds_)
    {
      std::vector<std::size_t> lines;
      std::vector<WrongRow>    wrong;
      for (std::size_t i = 0; i < kind.rows.size(); ++i)
      {
        lines.push_back(table_.line(kind.rows[i]));
        wrong.push_back({lines.back(), sentence(kind, i, "")});
      }
      problems.error(sentence(kind, 0, and_others(lines)), std::move(wrong));
    }
  }

  std::optional<QuantityColumn> find_quantity(const CsvTable &table, const std::string &column)
  {
    if (const auto index = table.find_column(column))
      return QuantityColumn{*index, 1.};
    const std::vector<std::size_t> others = columns_in_other_units(table, column);
    if (others.size() != 1)
      return std::nullopt;
    return QuantityColumn{others.front(), *factor_between_names(table.column_names()[others.front()], column)};
  }

  std::vector<double> scaled_cells(const CsvTable &table, const std::size_t column,
                                   const std::vector<std::size_t> &rows, const double factor, DataProblems &problems)
  {
    CellFaults          faults(table, column);
    std::vector<double> values;
    for (const std::size_t row : rows)
      if (const std::optional<double> value = table.number(row, column))
        values.push_back(*value * factor);
      else
        faults.add_no_number(row);
    faults.note(problems);
    return values;
  }

  void require_increasing(const CsvTable &table, const std::size_t column, const std::vector<std::size_t> &rows,
                          const std::vector<double> &time_s, DataProblems &problems)
  {
    constexpr std::size_t    many   = 4; // times as many as need be
    std::vector<std::size_t> wrong  = behind_earlier_ones(time_s);
    const auto               fewest = fewest_out_of_order(time_s);
    if (wrong.size() > many * fewest.size())
      wrong = fewest;
    CellFaults faults(table, column);
    for (const std::size_t i : wrong)
      faults.add(rows[i], fault_of_order(time_s, wrong, i), "sort the rows by time and keep one per instant");
    faults.note(problems);
  }

  void warn_of_conversions(const CsvTable &table, const std::vector<std::string> &columns, DataProblems &problems)
  {
    std::vector<std::string> words;
    for (const std::string &column : columns)
      if (const auto found = find_quantity(table, column); found && found->factor != 1.)
        words.push_back(
            fmt::format("{} = {:.6g} times \"{}\"", column, found->factor, table.column_names()[found->index]));
    if (!words.empty())
      problems.warning(fmt::format("{}: units are converted: {}.", table.where_header(), fmt::join(words, ", ")));
  }

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
