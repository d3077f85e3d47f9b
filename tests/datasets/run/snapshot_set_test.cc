#include <datasets/run/snapshot_set.h>

#include <datasets/files/hdf5_file.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace
  {
    /// One quadratic triangle and `n_snapshots` random states of it.
    SnapshotSet example_set(const int n_snapshots)
    {
      SnapshotSet set;
      set.tail_nodes_m = (Eigen::MatrixXd(6, 2) << 0, 0, 1, 0, 0, 1, .5, 0, .5, .5, 0, .5).finished();
      set.tail_cells   = (Eigen::MatrixXi(1, 6) << 0, 1, 2, 3, 4, 5).finished();
      set.clamped_nodes.resize(3);
      set.clamped_nodes << 0, 2, 5;
      set.tail_mass_m2.resize(12, 12);
      for (int i = 0; i < 12; ++i)
        set.tail_mass_m2.insert(i, (5 * i) % 12) = 0.1 * (i + 1);
      set.tail_mass_m2.makeCompressed();
      for (int i = 0; i < n_snapshots; ++i)
        set.time_s.push_back(0.1 * i);
      set.tail_displacement_m = Eigen::MatrixXd::Random(n_snapshots, 12);
      set.tail_velocity_m_s   = Eigen::MatrixXd::Random(n_snapshots, 12);
      set.pose                = Eigen::MatrixXd::Random(n_snapshots, 3);
      set.field_T             = Eigen::MatrixXd::Random(n_snapshots, 3);
      return set;
    }

    const Provenance of_a_run{"swimtwin 0.1.0", "simulate", "dimension = 2\n", "abc", "2025-01-31T12:00:00Z", 7.};
  } // namespace

  TEST(SnapshotSet, RoundTripKeepsEveryBit)
  {
    const TemporaryFolder folder;
    const SnapshotSet     written = example_set(4);
    write_snapshots(folder.path / "snapshots.h5", written, of_a_run);
    const SnapshotSet read = read_snapshots(folder.path / "snapshots.h5");
    EXPECT_EQ(read.tail_nodes_m, written.tail_nodes_m);
    EXPECT_EQ(read.tail_cells, written.tail_cells);
    EXPECT_EQ(read.clamped_nodes, written.clamped_nodes);
    EXPECT_EQ(Eigen::MatrixXd(read.tail_mass_m2), Eigen::MatrixXd(written.tail_mass_m2));
    EXPECT_EQ(read.time_s, written.time_s);
    EXPECT_EQ(read.tail_displacement_m, written.tail_displacement_m);
    EXPECT_EQ(read.tail_velocity_m_s, written.tail_velocity_m_s);
    EXPECT_EQ(read.pose, written.pose);
    EXPECT_EQ(read.field_T, written.field_T);
    EXPECT_EQ(n_files(folder.path), 1u);
  }

  TEST(SnapshotSet, ASetWithoutSnapshotsIsASet)
  {
    const TemporaryFolder folder;
    write_snapshots(folder.path / "snapshots.h5", example_set(0), of_a_run);
    EXPECT_TRUE(read_snapshots(folder.path / "snapshots.h5").time_s.empty());
  }

  TEST(SnapshotSet, CarriesUnitsAndProvenance)
  {
    const TemporaryFolder folder;
    write_snapshots(folder.path / "snapshots.h5", example_set(2), of_a_run);
    const Hdf5Reader reader(folder.path / "snapshots.h5");
    EXPECT_EQ(reader.read_text_attribute("/snapshots/velocity_m_s", "units"), "m/s");
    EXPECT_EQ(reader.read_text_attribute("/tail/mass/values", "units"), "m^2");
    EXPECT_FALSE(reader.read_text_attribute("/tail/cells", "description").empty());
    EXPECT_EQ(reader.read_text_attribute("/", "scene_text"), of_a_run.scene_text);
    EXPECT_EQ(reader.read_text_attribute("/", "scene_hash"), "abc");
    EXPECT_EQ(reader.read_number_attribute("/", "wall_time_s"), 7.);
  }

  TEST(SnapshotSet, RefusesATruncatedFile)
  {
    const TemporaryFolder folder;
    const auto            file = folder.path / "snapshots.h5";
    write_snapshots(file, example_set(4), of_a_run);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    expect_in(message_of<InputError>([&] { read_snapshots(file); }), "snapshots.h5: it was cut short");
  }

  TEST(SnapshotSet, NamesAMissingDataset)
  {
    const TemporaryFolder folder;
    Hdf5Writer            writer;
    writer.write_matrix("/tail/nodes_m", Eigen::MatrixXd(Eigen::MatrixXd::Zero(6, 2)), {"m", "nodes"});
    writer.save(folder.path / "model.h5");
    const std::string message = message_of<InputError>([&] { read_snapshots(folder.path / "model.h5"); });
    expect_in(message, "model.h5: /tail/cells is missing");
  }

  TEST(SnapshotSet, RefusesArraysThatDoNotFitTogether)
  {
    const TemporaryFolder folder;
    SnapshotSet           set = example_set(4);
    set.pose.conservativeResize(3, 3);
    write_snapshots(folder.path / "snapshots.h5", set, of_a_run);
    const std::string message = message_of<InputError>([&] { read_snapshots(folder.path / "snapshots.h5"); });
    expect_in(message, "/snapshots/pose has 3 x 3 values; 4 x 3 are needed");

    set = example_set(4);
    set.tail_mass_m2.resize(11, 11);
    write_snapshots(folder.path / "mass.h5", set, of_a_run);
    expect_in(message_of<InputError>([&] { read_snapshots(folder.path / "mass.h5"); }),
              "/tail/mass is not a sparse matrix");
  }
} // namespace swimtwin
