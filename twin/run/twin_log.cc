#include <datasets/files/hdf5_provenance.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <twin/run/twin_log.h>
#include <twin/run/twin_rows.h>
#include <twin/watch/watchdog.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    std::vector<TableColumn> columns_of_numbers(const std::vector<TableColumn> &columns)
    {
      std::vector<TableColumn> numbers;
      for (const TableColumn &column : columns)
        if (column.name != flags_column)
          numbers.push_back(column);
        else
          for (const char *flag : watch_flags)
            numbers.push_back({fmt::format("flag_{}", flag), {"1", "1 while the alarm is on, else 0"}});
      return numbers;
    }

    /// NaN for an empty cell.
    double number_of(const std::string_view cell)
    {
      double value = std::numeric_limits<double>::quiet_NaN();
      std::from_chars(cell.data(), cell.data() + cell.size(), value);
      return value;
    }

    bool has_word(const std::string_view words, const std::string_view word)
    {
      return fmt::format(";{};", words).find(fmt::format(";{};", word)) != std::string::npos;
    }
  } // namespace

  TwinLog::TwinLog(fs::path file, std::vector<TableColumn> columns)
      : file_(std::move(file)), columns_(std::move(columns))
  {
  }

  std::vector<double> TwinLog::numbers_of(const std::string &row) const
  {
    std::vector<double> numbers;
    std::string_view    rest = row;
    for (const TableColumn &column : columns_)
    {
      const std::string_view cell = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(rest.size(), cell.size() + 1));
      if (column.name != flags_column)
        numbers.push_back(number_of(cell));
      else
        for (const char *flag : watch_flags)
          numbers.push_back(has_word(cell, flag) ? 1. : 0.);
    }
    return numbers;
  }

  void TwinLog::give_up(const std::string &why)
  {
    table_.reset();
    warn(fmt::format("{} The twin goes on without it; twin.csv has every row.", why));
  }

  void TwinLog::begin(const Provenance &provenance)
  {
    try
    {
      table_ = Hdf5Table::create(file_, columns_of_numbers(columns_), provenance_texts(provenance));
    }
    catch (const ComputationError &error)
    {
      give_up(error.what());
    }
  }

  void TwinLog::resume(const fs::path &csv, const long n_rows, const Provenance &provenance)
  {
    table_ = Hdf5Table::reopen(file_, columns_of_numbers(columns_), static_cast<std::size_t>(n_rows));
    if (table_)
      return;
    begin(provenance);
    constexpr std::size_t    block = 4096;
    std::ifstream            in(csv);
    std::vector<std::string> rows;
    std::string              line;
    std::getline(in, line); // the header
    for (long i = 0; i < n_rows && std::getline(in, line); ++i)
    {
      rows.push_back(line);
      if (rows.size() < block)
        continue;
      append(rows);
      rows.clear();
    }
    append(rows);
  }

  void TwinLog::append(const std::span<const std::string> rows)
  {
    if (!table_)
      return;
    std::vector<std::vector<double>> numbers(rows.size());
    std::transform(rows.begin(), rows.end(), numbers.begin(), [&](const auto &row) { return numbers_of(row); });
    try
    {
      table_->append(numbers);
    }
    catch (const ComputationError &error)
    {
      give_up(error.what());
    }
  }
} // namespace swimtwin
