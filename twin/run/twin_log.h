// twin.h5: what twin.csv says, as arrays.
#pragma once

#include <datasets/files/hdf5_table.h>
#include <datasets/system/provenance.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace swimtwin
{
  /// A dataset for each column of numbers, and for each flag one of 0 and 1. Rows are lines of twin.csv.
  /// twin.csv is the one that must be whole: if this one cannot be written, a warning says so and
  /// the twin goes on.
  class TwinLog
  {
  public:
    /// `columns` of twin.csv.
    TwinLog(std::filesystem::path file, std::vector<TableColumn> columns);

    void begin(const Provenance &provenance);
    /// Behind the first `n_rows` of `csv`, from which the file is written anew if it lacks them.
    void resume(const std::filesystem::path &csv, long n_rows, const Provenance &provenance);
    void append(std::span<const std::string> rows);

  private:
    std::vector<double> numbers_of(const std::string &row) const;
    void                give_up(const std::string &why);

    std::filesystem::path    file_;
    std::vector<TableColumn> columns_;
    std::optional<Hdf5Table> table_; ///< none if it cannot be written
  };
} // namespace swimtwin
