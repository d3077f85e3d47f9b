#include <datasets/files/hdf5_file.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <hdf5.h>

namespace swimtwin
{
  namespace
  {
    /// A file of HDF5's own calls, which makes what our writer does not.
    template <typename Fill>
    void make_raw_file(const std::filesystem::path &file, const Fill &fill)
    {
      const Hdf5Handle id(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
      ASSERT_GE(id.id(), 0);
      fill(id.id());
    }

    Hdf5Handle raw_space(const std::vector<hsize_t> &sizes)
    {
      return {sizes.empty() ? H5Screate(H5S_SCALAR)
                            : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
              H5Sclose};
    }

    /// In chunks of that length in each direction, if it is given.
    Hdf5Handle add_raw_dataset(const hid_t file, const char *name, const hid_t type, const std::vector<hsize_t> &sizes,
                               const hsize_t chunk = 0, const unsigned int deflation = 0)
    {
      const Hdf5Handle space = raw_space(sizes), layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      if (chunk > 0)
        H5Pset_chunk(layout.id(), static_cast<int>(sizes.size()), std::vector<hsize_t>(sizes.size(), chunk).data());
      if (deflation > 0)
        H5Pset_deflate(layout.id(), deflation);
      return {H5Dcreate2(file, name, type, space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT), H5Dclose};
    }

    void add_raw_attribute(const hid_t file, const char *name, const hid_t type, const std::vector<hsize_t> &sizes)
    {
      const Hdf5Handle space = raw_space(sizes);
      const Hdf5Handle attribute(H5Acreate2(file, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    }
  } // namespace

  TEST(Hdf5File, RoundTripKeepsEveryKindOfArray)
  {
    const TemporaryFolder folder;
    const auto            file   = folder.path / "file.h5";
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(3, 5);
    const Eigen::MatrixXi cells  = (Eigen::MatrixXi(2, 3) << 1, 2, 3, 4, 5, 6).finished();
    const std::string     text(100000, 'x'); // longer than an object header may be
    Hdf5Writer            writer;
    writer.write_matrix("/a/b/matrix", matrix, {"m", "random"});
    writer.write_matrix("/a/cells", cells, {"1", "cells"});
    writer.write_vector("/a/b/values", std::vector<double>{1., 2.}, {"s", "times"});
    writer.write_vector("/counts", std::vector<int>{3}, {"1", "counts"});
    writer.write_vector("/eigen", Eigen::VectorXd(Eigen::VectorXd::Ones(4)), {"1", "ones"});
    writer.write_vector("/nothing", std::vector<double>{}, {"1", "an empty vector"});
    writer.write_text("/scene", text, {"", "TOML"});
    writer.write_attribute("/", "long", text);
    writer.write_attribute("/a", "version", 1.5);
    writer.save(file);

    const Hdf5Reader reader(file);
    EXPECT_EQ(reader.read_matrix("/a/b/matrix"), matrix);
    EXPECT_EQ(reader.read_int_matrix("/a/cells"), cells);
    EXPECT_EQ(reader.read_vector("/a/b/values"), (std::vector<double>{1., 2.}));
    EXPECT_EQ(reader.read_int_vector("/counts"), std::vector<int>{3});
    EXPECT_EQ(reader.read_vector("/eigen"), std::vector<double>(4, 1.));
    EXPECT_TRUE(reader.read_vector("/nothing").empty());
    EXPECT_EQ(reader.read_text("/scene"), text);
    EXPECT_EQ(reader.read_text_attribute("/", "long"), text);
    EXPECT_EQ(reader.read_number_attribute("/a", "version"), 1.5);
    EXPECT_EQ(reader.read_text_attribute("/a/b/matrix", "units"), "m");
    EXPECT_EQ(reader.read_text_attribute("/scene", "units"), "");
    EXPECT_TRUE(reader.contains("/a/b/matrix"));
    EXPECT_FALSE(reader.contains("/a/c/matrix"));
  }

  TEST(Hdf5File, FullDiskIsReportedAndKeepsTheEarlierFile)
  {
    const TemporaryFolder folder;
    const auto            file = folder.write("file.h5", "earlier");
    std::filesystem::create_symlink("/dev/full", temporary_name(file));
    Hdf5Writer writer;
    writer.write_vector("/values", std::vector<double>(1000, 1.), {"1", "ones"});
    expect_in(message_of<ComputationError>([&] { writer.save(file); }), "file.h5: No space left on device");
    EXPECT_EQ(content(file), "earlier");
  }

  TEST(Hdf5File, RefusesWhatIsMissingOrOfAnotherKind)
  {
    const TemporaryFolder folder;
    const auto            file = folder.path / "file.h5";
    Hdf5Writer            writer;
    writer.write_vector("/group/values", std::vector<double>{1.}, {"1", "one"});
    writer.save(file);
    const Hdf5Reader reader(file);
    const auto       message = [&](const auto &read) { return message_of<InputError>(read); };
    expect_in(message([&] { reader.read_vector("/other/values"); }), "file.h5: /other/values is missing");
    expect_in(message([&] { reader.read_vector("/group"); }), "/group is not a dataset");
    expect_in(message([&] { reader.read_int_vector("/group/values"); }), "does not hold whole numbers");
    expect_in(message([&] { reader.read_matrix("/group/values"); }), "is not an array of 2 dimensions");
    expect_in(message([&] { reader.read_text("/group/values"); }), "does not hold a text");
    expect_in(message([&] { reader.read_text_attribute("/group", "units"); }), "has no attribute units");
  }

  // Where one value is read there may be no more: it would be written behind its place.
  TEST(Hdf5File, RefusesArraysInThePlaceOfSingleValues)
  {
    const TemporaryFolder folder;
    const auto            file = folder.path / "file.h5";
    make_raw_file(file, [](const hid_t id) {
      const Hdf5Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
      H5Tset_size(text.id(), 8);
      add_raw_dataset(id, "texts", text.id(), {1000});
      add_raw_attribute(id, "texts", text.id(), {1000});
      add_raw_attribute(id, "numbers", H5T_NATIVE_DOUBLE, {1000});
      add_raw_attribute(id, "word", text.id(), {});
      add_raw_attribute(id, "number", H5T_NATIVE_DOUBLE, {});
    });
    const Hdf5Reader reader(file);
    const auto       message = [&](const auto &read) { return message_of<InputError>(read); };
    expect_in(message([&] { reader.read_text("/texts"); }), "/texts does not hold a text");
    expect_in(message([&] { reader.read_text_attribute("/", "texts"); }), "attribute texts that is not a text");
    expect_in(message([&] { reader.read_text_attribute("/", "number"); }), "attribute number that is not a text");
    expect_in(message([&] { reader.read_number_attribute("/", "numbers"); }), "attribute numbers that is not a number");
    expect_in(message([&] { reader.read_number_attribute("/", "word"); }), "attribute word that is not a number");
  }

  TEST(Hdf5File, RefusesValuesThatAreClaimedAndNotThere)
  {
    const TemporaryFolder folder;
    const auto            file = folder.path / "file.h5";
    make_raw_file(file, [](const hid_t id) {
      add_raw_dataset(id, "never_written", H5T_NATIVE_DOUBLE, {hsize_t(1) << 40}, 1 << 16);
      add_raw_dataset(id, "table", H5T_NATIVE_INT, {hsize_t(1) << 20, hsize_t(1) << 28}, 256);
    });
    const Hdf5Reader reader(file);
    const auto       message = [&](const auto &read) { return message_of<InputError>(read); };
    expect_in(message([&] { reader.read_vector("/never_written"); }), "claims more values than the file holds");
    expect_in(message([&] { reader.read_int_matrix("/table"); }), "claims more values than the file holds");
  }

  TEST(Hdf5File, ReadsWhatAnotherProgramCompressed)
  {
    const TemporaryFolder folder;
    const auto            file = folder.path / "file.h5";
    make_raw_file(file, [](const hid_t id) {
      const std::vector<double> zeros(100000, 0.);
      const Hdf5Handle          data = add_raw_dataset(id, "zeros", H5T_NATIVE_DOUBLE, {zeros.size()}, 100000, 9);
      H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data());
    });
    EXPECT_EQ(Hdf5Reader(file).read_vector("/zeros").size(), 100000u);
  }

  TEST(Hdf5File, RefusesForeignAndMissingFiles)
  {
    const TemporaryFolder folder;
    const auto            foreign = folder.write("foreign.h5", "time_s,bx_T\n");
    expect_in(message_of<InputError>([&] { Hdf5Reader reader(foreign); }), "foreign.h5: it is not an HDF5 file");
    expect_in(message_of<InputError>([&] { Hdf5Reader reader(folder.path / "no.h5"); }),
              "no.h5: No such file or directory");
  }
} // namespace swimtwin
