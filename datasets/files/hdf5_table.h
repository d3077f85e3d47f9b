// A table in HDF5 that grows while others read it.
#pragma once

#include <datasets/files/hdf5_file.h>

#include <map>
#include <optional>

namespace swimtwin
{
  struct TableColumn
  {
    std::string  name;
    ArrayMeaning meaning;
  };

  /// One dataset of numbers per column, NaN where nothing is known. Any program may read the file at any time, and hold
  /// it open: between two appends it is closed; while rows are appended (milliseconds), and after a kill in the middle
  /// of that, it takes those that open it as one of many readers beside a single writer ("swmr").
  class Hdf5Table
  {
  public:
    /// `attributes` of the file itself. Throws ComputationError that names the file.
    static Hdf5Table create(const std::filesystem::path &file, std::vector<TableColumn> columns,
                            const std::map<std::string, std::string> &attributes);
    /// Go on behind the first `n_rows`; what follows them goes. None if they are not there, the columns are others, or
    /// the file cannot be opened to write.
    static std::optional<Hdf5Table> reopen(const std::filesystem::path &file, std::vector<TableColumn> columns,
                                           std::size_t n_rows);

    /// Rows hold a number for each column. Throws ComputationError that names the file.
    void append(std::span<const std::vector<double>> rows);

    std::size_t n_rows() const { return n_rows_; }

  private:
    Hdf5Table(std::filesystem::path file, std::vector<TableColumn> columns, std::size_t n_rows);

    std::filesystem::path    file_;
    std::vector<TableColumn> columns_;
    std::size_t              n_rows_;
  };
} // namespace swimtwin
