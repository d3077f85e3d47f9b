#include <datasets/files/hdf5_open.h>
#include <datasets/files/hdf5_table.h>
#include <datasets/files/hdf5_text.h>
#include <datasets/system/error.h>

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <limits>
#include <system_error>

namespace swimtwin
{
  namespace
  {
    constexpr hsize_t rows_per_chunk = 1024; // 8 kB

    /// One writer beside many readers needs the format of HDF5 1.10, and no lock: readers hold one as long as they have
    /// the file open, and rows would wait for them.
    Hdf5Handle make_access()
    {
      silence_hdf5();
      Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_LATEST);
      H5Pset_file_locking(access.id(), false, true);
      return access;
    }

    std::int64_t done(const std::int64_t result, const std::filesystem::path &file)
    {
      if (result < 0)
        throw ComputationError(fmt::format("HDF5 cannot write {}.", file.string()));
      return result;
    }

    void write_attribute(const hid_t object, const std::string &name, const std::string &text,
                         const std::filesystem::path &file)
    {
      done(write_text_attribute(object, name, text) ? 0 : -1, file);
    }

    /// None if it is no column of such a table.
    std::optional<hsize_t> n_rows_of(const hid_t file, const std::string &column)
    {
      const Hdf5Handle data(H5Dopen2(file, column.c_str(), H5P_DEFAULT), H5Dclose);
      if (data.id() < 0)
        return std::nullopt;
      const Hdf5Handle space(H5Dget_space(data.id()), H5Sclose);
      hsize_t          n = 0, most = 0;
      if (H5Sget_simple_extent_ndims(space.id()) != 1 || H5Sget_simple_extent_dims(space.id(), &n, &most) < 0 ||
          most != H5S_UNLIMITED)
        return std::nullopt;
      return n;
    }
  } // namespace

  Hdf5Table::Hdf5Table(std::filesystem::path file, std::vector<TableColumn> columns, const std::size_t n_rows)
      : file_(std::move(file)), columns_(std::move(columns)), n_rows_(n_rows)
  {
  }

  Hdf5Table Hdf5Table::create(const std::filesystem::path &file, std::vector<TableColumn> columns,
                              const std::map<std::string, std::string> &attributes)
  {
    const Hdf5Handle access = make_access(), links(H5Pcreate(H5P_LINK_CREATE), H5Pclose),
                     layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    std::error_code ignored; // a file of old stays whole for those that have it open
    std::filesystem::remove(file, ignored);
    const Hdf5Handle whole(done(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), file), H5Fclose);
    for (const auto &[name, text] : attributes)
      write_attribute(whole.id(), name, text, file);
    const hsize_t    none = 0, unlimited = H5S_UNLIMITED;
    const double     unknown = std::numeric_limits<double>::quiet_NaN();
    const Hdf5Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose);
    done(H5Pset_chunk(layout.id(), 1, &rows_per_chunk), file);
    done(H5Pset_fill_value(layout.id(), H5T_NATIVE_DOUBLE, &unknown), file);
    for (const TableColumn &column : columns)
    {
      const Hdf5Handle data(done(H5Dcreate2(whole.id(), column.name.c_str(), H5T_NATIVE_DOUBLE, space.id(), links.id(),
                                            layout.id(), H5P_DEFAULT),
                                 file),
                            H5Dclose);
      write_attribute(data.id(), "units", column.meaning.units, file);
      write_attribute(data.id(), "description", column.meaning.description, file);
    }
    done(H5Fflush(whole.id(), H5F_SCOPE_LOCAL), file);
    return {file, std::move(columns), 0};
  }

  std::optional<Hdf5Table> Hdf5Table::reopen(const std::filesystem::path &file, std::vector<TableColumn> columns,
                                             const std::size_t n_rows)
  {
    const Hdf5Handle access = make_access();
    const Hdf5Handle whole(H5Fopen(file.c_str(), H5F_ACC_RDWR, access.id()), H5Fclose);
    if (whole.id() < 0)
      return std::nullopt;
    for (const TableColumn &column : columns)
      if (const auto n = n_rows_of(whole.id(), column.name); !n || *n < n_rows)
        return std::nullopt;
    const hsize_t wanted = n_rows;
    for (const TableColumn &column : columns)
    {
      const Hdf5Handle data(H5Dopen2(whole.id(), column.name.c_str(), H5P_DEFAULT), H5Dclose);
      if (H5Dset_extent(data.id(), &wanted) < 0)
        return std::nullopt;
    }
    return Hdf5Table(file, std::move(columns), n_rows);
  }

  void Hdf5Table::append(const std::span<const std::vector<double>> rows)
  {
    if (rows.empty())
      return;
    const Hdf5Handle    access = make_access();
    const Hdf5Handle    whole(done(H5Fopen(file_.c_str(), H5F_ACC_RDWR | H5F_ACC_SWMR_WRITE, access.id()), file_),
                              H5Fclose);
    const hsize_t       first = n_rows_, n = rows.size(), total = first + n;
    const Hdf5Handle    memory(H5Screate_simple(1, &n, nullptr), H5Sclose);
    std::vector<double> values(rows.size());
    for (std::size_t i = 0; i < columns_.size(); ++i)
    {
      std::transform(rows.begin(), rows.end(), values.begin(), [&](const auto &row) { return row.at(i); });
      const Hdf5Handle data(done(H5Dopen2(whole.id(), columns_[i].name.c_str(), H5P_DEFAULT), file_), H5Dclose);
      done(H5Dset_extent(data.id(), &total), file_);
      const Hdf5Handle space(H5Dget_space(data.id()), H5Sclose);
      done(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, &first, nullptr, &n, nullptr), file_);
      done(H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT, values.data()), file_);
    }
    done(H5Fflush(whole.id(), H5F_SCOPE_LOCAL), file_);
    n_rows_ = total;
  }
} // namespace swimtwin
