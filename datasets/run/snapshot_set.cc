#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_provenance.h>
#include <datasets/run/snapshot_set.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    using RowMajorSparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    void write_mass(Hdf5Writer &writer, RowMajorSparse mass)
    {
      mass.makeCompressed();
      const auto n_entries = static_cast<std::size_t>(mass.nonZeros());
      writer.write_vector("/tail/mass/row_starts",
                          std::span<const int>(mass.outerIndexPtr(), static_cast<std::size_t>(mass.rows()) + 1),
                          {"1", "CSR: index of the first entry of each row, then the number of entries"});
      writer.write_vector("/tail/mass/columns", std::span<const int>(mass.innerIndexPtr(), n_entries),
                          {"1", "CSR: column of each entry"});
      writer.write_vector("/tail/mass/values", std::span<const double>(mass.valuePtr(), n_entries),
                          {"m^2", "CSR: integral of N_i . N_j over the tail, unit density, interleaved components"});
    }

    void require(const Hdf5Reader &reader, const std::string &path, const bool condition, const std::string &problem)
    {
      if (!condition)
        reader.refuse(path, problem);
    }

    bool is_valid_csr(const std::vector<int> &row_starts, const std::vector<int> &columns, const Eigen::Index n)
    {
      bool valid = static_cast<Eigen::Index>(row_starts.size()) == n + 1 && row_starts.front() == 0 &&
                   static_cast<std::size_t>(row_starts.back()) == columns.size();
      for (std::size_t i = 1; valid && i < row_starts.size(); ++i)
        valid = row_starts[i] >= row_starts[i - 1];
      for (std::size_t i = 0; valid && i < columns.size(); ++i)
        valid = columns[i] >= 0 && columns[i] < n;
      return valid;
    }

    Eigen::SparseMatrix<double> read_mass(const Hdf5Reader &reader, const Eigen::Index n)
    {
      const std::vector<int>    row_starts = reader.read_int_vector("/tail/mass/row_starts");
      const std::vector<int>    columns    = reader.read_int_vector("/tail/mass/columns");
      const std::vector<double> values     = reader.read_vector("/tail/mass/values");
      require(reader, "/tail/mass", columns.size() == values.size() && is_valid_csr(row_starts, columns, n),
              fmt::format("is not a sparse matrix of {} rows.", n));
      return Eigen::Map<const RowMajorSparse>(n, n, static_cast<Eigen::Index>(values.size()), row_starts.data(),
                                              columns.data(), values.data());
    }

    Eigen::MatrixXd read_sized_matrix(const Hdf5Reader &reader, const std::string &path, const Eigen::Index rows,
                                      const Eigen::Index columns)
    {
      Eigen::MatrixXd matrix = reader.read_matrix(path);
      require(reader, path, matrix.rows() == rows && matrix.cols() == columns,
              fmt::format("has {} x {} values; {} x {} are needed.", matrix.rows(), matrix.cols(), rows, columns));
      return matrix;
    }
  } // namespace

  void write_snapshots(const std::filesystem::path &file, const SnapshotSet &set, const Provenance &provenance)
  {
    Hdf5Writer writer;
    writer.write_matrix(
        "/tail/nodes_m", set.tail_nodes_m,
        {"m", "nodes of the quadratic tail mesh, reference configuration, origin at the head's centre"});
    writer.write_matrix("/tail/cells", set.tail_cells,
                        {"1", "nodes of each triangle: three vertices, then midpoints of edges 01, 12, 20"});
    writer.write_vector("/tail/clamped_nodes", set.clamped_nodes, {"1", "nodes on the head"});
    write_mass(writer, set.tail_mass_m2);
    writer.write_vector("/snapshots/time_s", std::span<const double>(set.time_s), {"s", "time of each snapshot"});
    writer.write_matrix("/snapshots/displacement_m", set.tail_displacement_m,
                        {"m", "tail displacement in the head's frame, interleaved components, one snapshot per row"});
    writer.write_matrix("/snapshots/velocity_m_s", set.tail_velocity_m_s,
                        {"m/s", "rate of the tail displacement in the head's frame, laid out like it"});
    writer.write_matrix("/snapshots/pose", set.pose, {"m, m, rad", "x and y of the head's centre, angle"});
    if (set.pose_in_space.size() > 0)
      writer.write_matrix("/snapshots/pose_in_space", set.pose_in_space,
                          {"m, m, m, 1, 1, 1, 1", "x, y and z of the head's centre, its rotation as a unit quaternion: "
                                                  "w, x, y, z"});
    writer.write_matrix("/snapshots/field_T", set.field_T, {"T", "magnetic flux density"});
    write_provenance(writer, provenance);
    writer.save(file);
  }

  SnapshotSet read_snapshots(const std::filesystem::path &file)
  {
    const Hdf5Reader reader(file);
    SnapshotSet      set;
    set.tail_nodes_m               = reader.read_matrix("/tail/nodes_m");
    set.tail_cells                 = reader.read_int_matrix("/tail/cells");
    const std::vector<int> clamped = reader.read_int_vector("/tail/clamped_nodes");
    set.clamped_nodes              = Eigen::VectorXi::Map(clamped.data(), static_cast<Eigen::Index>(clamped.size()));
    const Eigen::Index n           = set.tail_nodes_m.size();
    set.tail_mass_m2               = read_mass(reader, n);
    set.time_s                     = reader.read_vector("/snapshots/time_s");
    const auto n_snapshots         = static_cast<Eigen::Index>(set.time_s.size());
    set.tail_displacement_m        = read_sized_matrix(reader, "/snapshots/displacement_m", n_snapshots, n);
    set.tail_velocity_m_s          = read_sized_matrix(reader, "/snapshots/velocity_m_s", n_snapshots, n);
    set.pose                       = read_sized_matrix(reader, "/snapshots/pose", n_snapshots, 3);
    if (reader.contains("/snapshots/pose_in_space"))
      set.pose_in_space = read_sized_matrix(reader, "/snapshots/pose_in_space", n_snapshots, 7);
    set.field_T = read_sized_matrix(reader, "/snapshots/field_T", n_snapshots, 3);
    return set;
  }
} // namespace swimtwin
