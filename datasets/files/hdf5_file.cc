#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_open.h>
#include <datasets/files/hdf5_text.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/error.h>

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

namespace swimtwin
{
  static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

  namespace
  {
    constexpr std::size_t memory_step_bytes = std::size_t(1) << 22;

    template <typename Scalar>
    using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// What cannot fail with memory at hand: a failure is a defect (a path written twice, say) or a lack of memory.
    std::int64_t composed(const std::int64_t result, const std::string &what)
    {
      if (result < 0)
        throw ComputationError(fmt::format("HDF5 refuses to write {}", what));
      return result;
    }

    Hdf5Handle make_memory_file()
    {
      silence_hdf5();
      const Hdf5Handle access(composed(H5Pcreate(H5P_FILE_ACCESS), "a file"), H5Pclose);
      composed(H5Pset_fapl_core(access.id(), memory_step_bytes, false), "a file");
      // The format of 1.8 takes attributes beyond 64 kB, which scene texts may reach. That of 1.10 marks an open file
      // as being written, also in its image.
      composed(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18), "a file");
      const hid_t file = H5Fcreate("composed in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access.id());
      return {composed(file, "a file"), H5Fclose};
    }

    /// Whether a file can hold what one of its objects claims to be: a damaged one may claim any size. Filters shrink
    /// values by a thousand at most.
    bool can_hold(const hid_t object, const hsize_t stored_bytes, const hsize_t n, const hsize_t value_bytes,
                  const bool has_filters)
    {
      constexpr hsize_t highest_ratio = 1100; // above that of deflate
      const Hdf5Handle  file(H5Iget_file_id(object), H5Fclose);
      hsize_t           file_bytes = 0;
      H5Fget_filesize(file.id(), &file_bytes);
      const hsize_t bytes = std::min(stored_bytes, file_bytes) * (has_filters ? highest_ratio : 1);
      return value_bytes == 0 || n <= bytes / value_bytes;
    }

    bool is_stored(const hid_t data, const hid_t space, const hid_t type)
    {
      const Hdf5Handle layout(H5Dget_create_plist(data), H5Pclose);
      return can_hold(data, H5Dget_storage_size(data), static_cast<hsize_t>(H5Sget_simple_extent_npoints(space)),
                      H5Tget_size(type), H5Pget_nfilters(layout.id()) > 0);
    }

    /// Whether an attribute is a single value, and no larger than its file.
    bool is_single(const hid_t attribute, const hid_t type)
    {
      const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
      return H5Sget_simple_extent_npoints(space.id()) == 1 &&
             can_hold(attribute, H5Aget_storage_size(attribute), 1, H5Tget_size(type), false);
    }

    bool is_text(const hid_t type)
    {
      return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    }

    bool is_number(const hid_t type)
    {
      return H5Tget_class(type) == H5T_FLOAT || H5Tget_class(type) == H5T_INTEGER;
    }

    std::string without_padding(std::string text)
    {
      text.erase(text.find_last_not_of('\0') + 1);
      return text;
    }
  } // namespace

  Hdf5Handle::Hdf5Handle(Hdf5Handle &&other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

  Hdf5Handle::~Hdf5Handle()
  {
    if (id_ >= 0)
      close_(id_);
  }

  Hdf5Writer::Hdf5Writer() : file_(make_memory_file()) {}

  void Hdf5Writer::write_array(const std::string &path, const void *values, const std::vector<std::size_t> &extents,
                               const std::int64_t type, const ArrayMeaning &meaning)
  {
    const std::vector<hsize_t> sizes(extents.begin(), extents.end());
    const int                  rank = static_cast<int>(sizes.size());
    const Hdf5Handle space(rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, sizes.data(), nullptr), H5Sclose);
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    composed(H5Pset_create_intermediate_group(links.id(), 1), path);
    const Hdf5Handle data(
        composed(H5Dcreate2(file_.id(), path.c_str(), type, space.id(), links.id(), H5P_DEFAULT, H5P_DEFAULT), path),
        H5Dclose);
    composed(H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path);
    write_attribute(path, "units", meaning.units);
    write_attribute(path, "description", meaning.description);
  }

  void Hdf5Writer::write_matrix(const std::string &path, const Eigen::MatrixXd &values, const ArrayMeaning &meaning)
  {
    const RowMajor<double> rows = values;
    write_array(path, rows.data(), {static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols())},
                H5T_NATIVE_DOUBLE, meaning);
  }

  void Hdf5Writer::write_matrix(const std::string &path, const Eigen::MatrixXi &values, const ArrayMeaning &meaning)
  {
    const RowMajor<int> rows = values;
    write_array(path, rows.data(), {static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols())},
                H5T_NATIVE_INT, meaning);
  }

  void Hdf5Writer::write_vector(const std::string &path, const std::span<const double> values,
                                const ArrayMeaning &meaning)
  {
    write_array(path, values.data(), {values.size()}, H5T_NATIVE_DOUBLE, meaning);
  }

  void Hdf5Writer::write_vector(const std::string &path, const std::span<const int> values, const ArrayMeaning &meaning)
  {
    write_array(path, values.data(), {values.size()}, H5T_NATIVE_INT, meaning);
  }

  void Hdf5Writer::write_vector(const std::string &path, const Eigen::VectorXd &values, const ArrayMeaning &meaning)
  {
    write_array(path, values.data(), {static_cast<std::size_t>(values.size())}, H5T_NATIVE_DOUBLE, meaning);
  }

  void Hdf5Writer::write_vector(const std::string &path, const Eigen::VectorXi &values, const ArrayMeaning &meaning)
  {
    write_array(path, values.data(), {static_cast<std::size_t>(values.size())}, H5T_NATIVE_INT, meaning);
  }

  void Hdf5Writer::write_text(const std::string &path, const std::string &text, const ArrayMeaning &meaning)
  {
    const std::string stored = padded(text);
    write_array(path, stored.data(), {}, make_text_type(stored.size()).id(), meaning);
  }

  void Hdf5Writer::write_attribute(const std::string &path, const std::string &name, const std::string &text)
  {
    const Hdf5Handle object(composed(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), path), H5Oclose);
    composed(write_text_attribute(object.id(), name, text) ? 0 : -1, path + " " + name);
  }

  void Hdf5Writer::write_attribute(const std::string &path, const std::string &name, const double value)
  {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle object(composed(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), path), H5Oclose);
    const Hdf5Handle attribute(
        composed(H5Acreate2(object.id(), name.c_str(), H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                 path + " " + name),
        H5Aclose);
    composed(H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, &value), path + " " + name);
  }

  void Hdf5Writer::save(const std::filesystem::path &file, const Seal seal) const
  {
    composed(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), file.string());
    // H5Fget_file_image copies, and its copy of a 1.8 file has a wrong checksum: ask it for the size only
    const ssize_t size   = H5Fget_file_image(file_.id(), nullptr, 0);
    void        **memory = nullptr;
    composed(size, file.string());
    composed(H5Fget_vfd_handle(file_.id(), H5P_DEFAULT, reinterpret_cast<void **>(&memory)), file.string());
    std::string image(static_cast<const char *>(*memory), static_cast<std::size_t>(size));
    if (seal == Seal::appended)
      image += seal_of(image);
    write_text_atomically(file, image);
  }

  Hdf5Reader::Hdf5Reader(const std::filesystem::path &file)
      : name_(file.string()), file_(open_hdf5_file(name_), H5Fclose)
  {
  }

  void Hdf5Reader::refuse(const std::string &path, const std::string &problem) const
  {
    throw InputError(fmt::format("{}: {} {}", name_, path, problem));
  }

  bool Hdf5Reader::contains(const std::string &path) const
  {
    const auto has_link = [&](const std::string &link) {
      const int exists = H5Lexists(file_.id(), link.c_str(), H5P_DEFAULT);
      if (exists < 0)
        refuse(path, "cannot be looked up; the file is damaged.");
      return exists > 0;
    };
    for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
      if (!has_link(path.substr(0, slash)))
        return false;
    return path == "/" || has_link(path);
  }

  bool Hdf5Reader::has_attribute(const std::string &path, const std::string &name) const
  {
    return contains(path) && H5Aexists_by_name(file_.id(), path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
  }

  Hdf5Handle Hdf5Reader::open(const std::string &path) const
  {
    if (!contains(path))
      refuse(path, "is missing.");
    const hid_t data = H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT);
    if (data < 0)
      refuse(path, "is not a dataset.");
    return {data, H5Dclose};
  }

  template <typename Scalar>
  std::vector<Scalar> Hdf5Reader::read_array(const std::string &path, const std::size_t rank,
                                             std::vector<std::size_t> &extents) const
  {
    const Hdf5Handle data = open(path);
    const Hdf5Handle space(H5Dget_space(data.id()), H5Sclose), type(H5Dget_type(data.id()), H5Tclose);
    const auto       needed_class = std::is_same_v<Scalar, int> ? H5T_INTEGER : H5T_FLOAT;
    if (H5Tget_class(type.id()) != needed_class)
      refuse(path, std::is_same_v<Scalar, int> ? "does not hold whole numbers." : "does not hold numbers.");
    if (H5Sget_simple_extent_ndims(space.id()) != static_cast<int>(rank))
      refuse(path, fmt::format("is not an array of {} dimension{}.", rank, rank == 1 ? "" : "s"));

    if (!is_stored(data.id(), space.id(), type.id()))
      refuse(path, "claims more values than the file holds; the file is damaged.");

    std::vector<hsize_t> sizes(rank);
    H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr);
    extents.assign(sizes.begin(), sizes.end());
    std::vector<Scalar> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id())));
    const hid_t         memory_type = std::is_same_v<Scalar, int> ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
    if (H5Dread(data.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      refuse(path, "cannot be read; the file is damaged.");
    return values;
  }

  template <typename Scalar>
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> Hdf5Reader::read_matrix_of(const std::string &path) const
  {
    std::vector<std::size_t>  extents;
    const std::vector<Scalar> values = read_array<Scalar>(path, 2, extents);
    return Eigen::Map<const RowMajor<Scalar>>(values.data(), static_cast<Eigen::Index>(extents[0]),
                                              static_cast<Eigen::Index>(extents[1]));
  }

  Eigen::MatrixXd Hdf5Reader::read_matrix(const std::string &path) const
  {
    return read_matrix_of<double>(path);
  }

  Eigen::MatrixXi Hdf5Reader::read_int_matrix(const std::string &path) const
  {
    return read_matrix_of<int>(path);
  }

  std::vector<double> Hdf5Reader::read_vector(const std::string &path) const
  {
    std::vector<std::size_t> extents;
    return read_array<double>(path, 1, extents);
  }

  std::vector<int> Hdf5Reader::read_int_vector(const std::string &path) const
  {
    std::vector<std::size_t> extents;
    return read_array<int>(path, 1, extents);
  }

  std::string Hdf5Reader::read_text(const std::string &path) const
  {
    const Hdf5Handle data = open(path);
    const Hdf5Handle type(H5Dget_type(data.id()), H5Tclose), space(H5Dget_space(data.id()), H5Sclose);
    if (!is_text(type.id()) || H5Sget_simple_extent_npoints(space.id()) != 1 ||
        !is_stored(data.id(), space.id(), type.id()))
      refuse(path, "does not hold a text.");
    std::string text(H5Tget_size(type.id()), '\0');
    if (H5Dread(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
      refuse(path, "cannot be read; the file is damaged.");
    return without_padding(text);
  }

  std::string Hdf5Reader::read_text_attribute(const std::string &path, const std::string &name) const
  {
    const Hdf5Handle attribute(H5Aopen_by_name(file_.id(), path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose);
    if (attribute.id() < 0)
      refuse(path, fmt::format("has no attribute {}.", name));
    const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
    if (!is_text(type.id()) || !is_single(attribute.id(), type.id()))
      refuse(path, fmt::format("has an attribute {} that is not a text.", name));
    std::string text(H5Tget_size(type.id()), '\0');
    if (H5Aread(attribute.id(), type.id(), text.data()) < 0)
      refuse(path, fmt::format("has an attribute {} that is not a text.", name));
    return without_padding(text);
  }

  double Hdf5Reader::read_number_attribute(const std::string &path, const std::string &name) const
  {
    const Hdf5Handle attribute(H5Aopen_by_name(file_.id(), path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose);
    if (attribute.id() < 0)
      refuse(path, fmt::format("has no attribute {}.", name));
    const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
    double           value = 0.;
    if (!is_number(type.id()) || !is_single(attribute.id(), type.id()) ||
        H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0)
      refuse(path, fmt::format("has an attribute {} that is not a number.", name));
    return value;
  }
} // namespace swimtwin
