#include <datasets/observation/observation_curve.h>
#include <datasets/text/unit_names.h>
#include <datasets/tracks/observed_cells.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace swimtwin
{
  namespace
  {
    struct CurveColumns
    {
      std::string value, sigma, unit;
    };

    bool is_speed(const std::string &name)
    {
      const auto reading = reading_with_unit(name);
      return reading && unit_factor(reading->unit, "m_s");
    }

    CurveColumns columns_of(const CsvTable &table)
    {
      const auto &names = table.column_names();
      if (!find_quantity(table, "displacement_m") && std::any_of(names.begin(), names.end(), is_speed))
        return {"mean_speed_m_s", "sigma_m_s", "m/s"};
      return {"displacement_m", "sigma_m", "m"};
    }

    std::vector<std::size_t> sorted_rows(const std::vector<double> &frequency_Hz)
    {
      std::vector<std::size_t> rows(frequency_Hz.size());
      std::iota(rows.begin(), rows.end(), std::size_t(0));
      std::stable_sort(rows.begin(), rows.end(),
                       [&](const auto a, const auto b) { return frequency_Hz[a] < frequency_Hz[b]; });
      return rows;
    }

    /// Several measurements at one frequency are data; the same number twice is most likely a row that was copied.
    void warn_of_copies(const CsvTable &table, const ObservationSet &set, const std::vector<std::size_t> &rows,
                        DataProblems &problems)
    {
      std::vector<std::size_t> lines;
      for (std::size_t i = 1; i < set.points.size(); ++i)
        for (std::size_t j = i; j-- > 0 && set.points[j].frequency_Hz == set.points[i].frequency_Hz;)
          if (set.points[j].displacement_m == set.points[i].displacement_m)
          {
            lines.push_back(table.line(rows[i]));
            break;
          }
      if (!lines.empty())
        problems.warning(
            fmt::format("{}:{}: frequency and value stand already on a line before{}; a copied row counts as "
                        "one more measurement: delete it if it is none.",
                        set.file.string(), lines.front(), and_others(lines)));
    }

    void refuse_twin_columns(const CsvTable &table, DataProblems &problems)
    {
      std::set<std::string> seen;
      for (const std::string &name : table.column_names())
        if (!name.empty() && !seen.insert(name).second)
          problems.error(fmt::format("{}: there are two columns {}; rename one of them.", table.where_header(), name));
    }

    void keep_extra_columns(const CsvTable &table, const CurveColumns &columns, const std::vector<std::size_t> &rows,
                            ObservationSet &set)
    {
      const auto &names   = table.column_names();
      const auto  is_read = [&](const std::size_t column) {
        for (const std::string &quantity : {std::string("frequency_Hz"), columns.value, columns.sigma})
          if (find_quantity(table, quantity)->index == column)
            return true;
        return false;
      };
      for (std::size_t column = 0; column < names.size(); ++column)
        if (!names[column].empty() && !is_read(column))
          for (const std::size_t row : rows)
            set.extra_columns[names[column]].push_back(table.cells(row)[column]);
    }

    struct Numbers
    {
      std::vector<double> frequency_Hz, value, sigma;
    };

    Numbers read_numbers(const CsvTable &table, const CurveColumns &columns, DataProblems &problems)
    {
      return {positive_cells(table, "frequency_Hz", "give the frequency of the field in Hz", problems),
              finite_cells(table, columns.value, columns.unit, problems),
              positive_cells(table, columns.sigma,
                             "give one standard deviation of " + columns.value + ", or leave the row out", problems)};
    }

    void warn_of_error_bars(const ObservationSet &set, DataProblems &problems)
    {
      const auto says_nothing = [](const Observation &p) { return p.sigma_m >= std::abs(p.displacement_m); };
      if (std::all_of(set.points.begin(), set.points.end(), says_nothing))
        problems.warning(fmt::format("{}: every error bar is as large as its displacement; check the unit of sigma.",
                                     set.file.string()));
      constexpr double finest   = 1e-5; // a micrometre over ten centimetres
      const auto       too_good = [](const Observation &p) { return p.sigma_m < finest * std::abs(p.displacement_m); };
      if (std::all_of(set.points.begin(), set.points.end(), too_good))
        problems.warning(fmt::format("{}: every error bar is below {:g} of its displacement, finer than a camera sees; "
                                     "check the unit of sigma.",
                                     set.file.string(), finest));
    }
  } // namespace

  void read_curve(const CsvTable &table, ObservationSet &set, DataProblems &problems)
  {
    const CurveColumns columns = columns_of(table);
    if (!has_names(table, {"frequency_Hz", columns.value, columns.sigma}, problems) ||
        has_row_of_units(table, problems))
      return;
    DataProblems own;
    refuse_twin_columns(table, own);
    const Numbers                  numbers = read_numbers(table, columns, own);
    const std::vector<std::size_t> rows    = sorted_rows(numbers.frequency_Hz);
    if (table.n_rows() < 2 && table.left_out().empty())
      own.error(fmt::format("{}: {} point(s) are no curve; at least 2 are needed, and more than parameters to fit.",
                            table.where_header(), table.n_rows()));
    problems.append(own);
    if (own.has_errors())
      return;
    set.quantity = columns.unit == "m" ? ObservedQuantity::displacement : ObservedQuantity::mean_speed;
    for (const std::size_t row : rows)
    {
      const double frequency_Hz = numbers.frequency_Hz[row], per_period = columns.unit == "m" ? 1. : frequency_Hz;
      set.points.push_back({frequency_Hz, numbers.value[row] / per_period, numbers.sigma[row] / per_period,
                            table.where(row), 0, 0., 0.});
    }
    keep_extra_columns(table, columns, rows, set);
    warn_of_copies(table, set, rows, problems);
    warn_of_conversions(table, {"frequency_Hz", columns.value, columns.sigma}, problems);
    warn_of_error_bars(set, problems);
  }
} // namespace swimtwin
