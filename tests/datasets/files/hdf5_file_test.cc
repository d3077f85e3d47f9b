#include <datasets/system/error.h>
#include <datasets/files/hdf5_file.h>
#include <datasets/files/output_folder.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
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

  TEST(Hdf5File, RefusesForeignAndMissingFiles)
  {
    const TemporaryFolder folder;
    const auto            foreign = folder.write("foreign.h5", "time_s,bx_T\n");
    expect_in(message_of<InputError>([&] { Hdf5Reader reader(foreign); }), "foreign.h5: it is not an HDF5 file");
    expect_in(message_of<InputError>([&] { Hdf5Reader reader(folder.path / "no.h5"); }),
              "no.h5: No such file or directory");
  }
} // namespace swimtwin
