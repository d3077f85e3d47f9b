// HDF5 files of named arrays that carry their units and a description. No HDF5 type appears here.
#pragma once

#include <Eigen/Dense>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace swimtwin
{
  /// Written beside every dataset as its attributes `units` and `description`.
  struct ArrayMeaning
  {
    std::string units; ///< "m", "1" for a pure number
    std::string description;
  };

  /// An open HDF5 object, closed at the end of its life.
  class Hdf5Handle
  {
  public:
    using Close = int (*)(std::int64_t);

    Hdf5Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
    Hdf5Handle(Hdf5Handle &&other) noexcept;
    Hdf5Handle &operator=(Hdf5Handle &&) = delete;
    ~Hdf5Handle();

    std::int64_t id() const { return id_; }

  private:
    std::int64_t id_;
    Close        close_;
  };

  /// Whether a checksum stands behind the content (see require_seal).
  enum class Seal { none, appended };

  /// Composes a file in memory and writes it as a whole: HDF5 itself never meets a full disk, from which its caches do
  /// not recover. Paths are absolute ("/tail/nodes_m"); groups on the way are created. Matrices are stored row by row.
  class Hdf5Writer
  {
  public:
    Hdf5Writer();

    void write_matrix(const std::string &path, const Eigen::MatrixXd &values, const ArrayMeaning &meaning);
    void write_matrix(const std::string &path, const Eigen::MatrixXi &values, const ArrayMeaning &meaning);
    void write_vector(const std::string &path, std::span<const double> values, const ArrayMeaning &meaning);
    void write_vector(const std::string &path, std::span<const int> values, const ArrayMeaning &meaning);
    void write_vector(const std::string &path, const Eigen::VectorXd &values, const ArrayMeaning &meaning);
    void write_vector(const std::string &path, const Eigen::VectorXi &values, const ArrayMeaning &meaning);
    void write_text(const std::string &path, const std::string &text, const ArrayMeaning &meaning);
    /// Attribute of a group or dataset that exists; "/" is the file itself.
    void write_attribute(const std::string &path, const std::string &name, const std::string &text);
    void write_attribute(const std::string &path, const std::string &name, double value);

    /// Write everything to a temporary name, then rename. Throws ComputationError naming the file and the cause.
    void save(const std::filesystem::path &file, Seal seal = Seal::none) const;

  private:
    void write_array(const std::string &path, const void *values, const std::vector<std::size_t> &extents,
                     std::int64_t type, const ArrayMeaning &meaning);

    Hdf5Handle file_;
  };

  /// Throws InputError that names the file and the path for everything missing, of another rank or type, or unreadable.
  class Hdf5Reader
  {
  public:
    explicit Hdf5Reader(const std::filesystem::path &file);

    bool                contains(const std::string &path) const;
    bool                has_attribute(const std::string &path, const std::string &name) const;
    Eigen::MatrixXd     read_matrix(const std::string &path) const;
    Eigen::MatrixXi     read_int_matrix(const std::string &path) const;
    std::vector<double> read_vector(const std::string &path) const;
    std::vector<int>    read_int_vector(const std::string &path) const;
    std::string         read_text(const std::string &path) const;
    std::string         read_text_attribute(const std::string &path, const std::string &name) const;
    double              read_number_attribute(const std::string &path, const std::string &name) const;

    /// Throw InputError `<file>: <path> <problem>`.
    [[noreturn]] void refuse(const std::string &path, const std::string &problem) const;

  private:
    Hdf5Handle open(const std::string &path) const;
    template <typename Scalar>
    std::vector<Scalar> read_array(const std::string &path, std::size_t rank, std::vector<std::size_t> &extents) const;
    template <typename Scalar>
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> read_matrix_of(const std::string &path) const;

    std::string name_;
    Hdf5Handle  file_;
  };
} // namespace swimtwin
