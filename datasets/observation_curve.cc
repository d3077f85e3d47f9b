#include <datasets/observation_curve.h>
#include <datasets/observed_cells.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace swimtwin
{
  namespace
  {
    constexpr double same_frequency = 1e-9; // relative

    struct Columns
    {
      std::string value, sigma, unit;
    };

    Columns columns_of(const CsvTable &table)
    {
      if (!table.has_column("displacement_m") && table.has_column("mean_speed_m_s"))
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

    void refuse_duplicates(const CsvTable &table, const std::vector<double> &frequency_Hz,
                           const std::vector<std::size_t> &rows, DataProblems &problems)
    {
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (frequency_Hz[rows[i]] <= frequency_Hz[rows[i - 1]] * (1. + same_frequency))
          problems.error(
              fmt::format("{}: {} stands already on line {}; average the two measurements into one row, or keep "
                          "them in two files.",
                          table.where(rows[i]), table.quote(rows[i], "frequency_Hz"), table.line(rows[i - 1])));
    }

    void refuse_twin_columns(const CsvTable &table, DataProblems &problems)
    {
      std::set<std::string> seen;
      for (const std::string &name : table.column_names())
        if (!seen.insert(name).second)
          problems.error(fmt::format("{}: there are two columns {}; rename one of them.", table.where_header(), name));
    }

    void keep_extra_columns(const CsvTable &table, const Columns &columns, const std::vector<std::size_t> &rows,
                            ObservationSet &set)
    {
      const auto &names = table.column_names();
      for (std::size_t column = 0; column < names.size(); ++column)
        if (names[column] != "frequency_Hz" && names[column] != columns.value && names[column] != columns.sigma)
          for (const std::size_t row : rows)
            set.extra_columns[names[column]].push_back(table.cells(row)[column]);
    }

    struct Numbers
    {
      std::vector<double> frequency_Hz, value, sigma;
    };

    Numbers read_numbers(const CsvTable &table, const Columns &columns, DataProblems &problems)
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
    DataProblems  own;
    const Columns columns = columns_of(table);
    refuse_twin_columns(table, own);
    const Numbers                  numbers = read_numbers(table, columns, own);
    const std::vector<std::size_t> rows    = sorted_rows(numbers.frequency_Hz);
    refuse_duplicates(table, numbers.frequency_Hz, rows, own);
    if (table.n_rows() < 2)
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
    warn_of_error_bars(set, problems);
  }
} // namespace swimtwin
