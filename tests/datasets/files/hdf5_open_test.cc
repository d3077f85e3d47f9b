#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_open.h>
#include <datasets/system/error.h>
#include <tests/datasets/other_process.h>
#include <tests/datasets/temporary_folder.h>

#include <fcntl.h>
#include <sys/file.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    fs::path write_file(const TemporaryFolder &folder, const Seal seal = Seal::none)
    {
      Hdf5Writer writer;
      writer.write_vector("/values", std::vector<double>(1000, 1.), {"1", "ones"});
      writer.save(folder.path / "file.h5", seal);
      return folder.path / "file.h5";
    }

    std::string refusal_of_hdf5(const fs::path &file)
    {
      return message_of<InputError>([&] { Hdf5Reader reader(file); });
    }

    void change_byte(const fs::path &file, const std::size_t place)
    {
      std::string text = content(file);
      text.at(place) ^= 1;
      std::ofstream(file, std::ios::binary) << text;
    }
  } // namespace

  TEST(Hdf5Open, TellsAFileThatWasCutShortFromAForeignOne)
  {
    const TemporaryFolder folder;
    for (const std::uintmax_t size : {5000, 100, 8, 5})
    {
      const fs::path file = write_file(folder);
      fs::resize_file(file, size);
      expect_in(refusal_of_hdf5(file), "it was cut short: " + std::to_string(size) + " bytes are left");
    }
    expect_in(refusal_of_hdf5(folder.write("text.h5", "time_s,bx_T\n")), "text.h5: it is not an HDF5 file.");
    expect_in(refusal_of_hdf5(folder.write("empty.h5", "")), "the file is empty");
    expect_in(refusal_of_hdf5(folder.write("pointer.h5", "version https://git-lfs.github.com/spec/v1\n")),
              "git lfs pull");
    expect_in(refusal_of_hdf5(folder.path), "Is a directory");
  }

  TEST(Hdf5Open, SaysThatAnotherProgramHoldsTheFile)
  {
    const TemporaryFolder folder;
    const fs::path        file = write_file(folder);
    OtherProcess          other([&] { ::flock(::open(file.c_str(), O_RDWR), LOCK_EX); });
    expect_in(refusal_of_hdf5(file), "file.h5: it is locked by another program");
    other.kill();
    EXPECT_EQ(Hdf5Reader(file).read_vector("/values").size(), 1000u);
  }

  TEST(Hdf5Open, SharesAFileWithOtherReaders)
  {
    const TemporaryFolder folder;
    const fs::path        file = write_file(folder);
    const OtherProcess    other([&] { ::flock(::open(file.c_str(), O_RDONLY), LOCK_SH); });
    EXPECT_EQ(Hdf5Reader(file).read_vector("/values").size(), 1000u);
  }

  TEST(Seal, HoldsAsLongAsNothingChanges)
  {
    const TemporaryFolder folder;
    const fs::path        file = write_file(folder, Seal::appended);
    EXPECT_NO_THROW(require_seal(file, "start afresh"));
    EXPECT_EQ(Hdf5Reader(file).read_vector("/values").size(), 1000u) << "HDF5 must not mind the seal";
  }

  TEST(Seal, BreaksWithAnyChange)
  {
    const TemporaryFolder folder;
    const auto            message = [&] {
      return message_of<InputError>([&] { require_seal(folder.path / "file.h5", "start afresh"); });
    };
    const std::size_t size = content(write_file(folder, Seal::appended)).size();
    for (const std::size_t place : {std::size_t(9), size / 2, size - 100, size - 20})
    {
      change_byte(write_file(folder, Seal::appended), place);
      expect_in(message(), "is damaged: its content is not what its checksum was made of; start afresh.");
    }
    fs::resize_file(write_file(folder, Seal::appended), size - 1);
    expect_in(message(), "ends without its checksum");
    write_file(folder);
    expect_in(message(), "ends without its checksum");
  }
} // namespace swimtwin
