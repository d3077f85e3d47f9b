#include <datasets/files/hdf5_table.h>
#include <tests/datasets/temporary_folder.h>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    const std::vector<TableColumn> two_columns = {{"time_s", {"s", "instant"}}, {"x_m", {"m", "place"}}};

    std::vector<std::vector<double>> rows_from(const int first, const int n)
    {
      std::vector<std::vector<double>> rows;
      for (int i = first; i < first + n; ++i)
        rows.push_back({0.1 * i, 1e-3 * i});
      return rows;
    }

    void expect_rows(const std::filesystem::path &file, const int n)
    {
      const Hdf5Reader reader(file);
      const auto       times = reader.read_vector("/time_s"), places = reader.read_vector("/x_m");
      ASSERT_EQ(times.size(), static_cast<std::size_t>(n));
      ASSERT_EQ(places.size(), static_cast<std::size_t>(n));
      for (int i = 0; i < n; ++i)
      {
        EXPECT_EQ(times[static_cast<std::size_t>(i)], 0.1 * i);
        EXPECT_EQ(places[static_cast<std::size_t>(i)], 1e-3 * i);
      }
    }
    /// As HDF5 holds a file that it reads, in a process of its own.
    class SharedLock
    {
    public:
      explicit SharedLock(const std::filesystem::path &file) : descriptor_(::open(file.c_str(), O_RDONLY))
      {
        EXPECT_EQ(::flock(descriptor_, LOCK_SH | LOCK_NB), 0);
      }
      ~SharedLock() { ::close(descriptor_); }
      SharedLock(const SharedLock &)            = delete;
      SharedLock &operator=(const SharedLock &) = delete;

    private:
      int descriptor_;
    };
  } // namespace

  TEST(Hdf5Table, IsReadBetweenAppends)
  {
    const TemporaryFolder folder;
    const auto            file  = folder.path / "table.h5";
    Hdf5Table             table = Hdf5Table::create(file, two_columns, {{"program_version", "1"}});
    expect_rows(file, 0);
    table.append(rows_from(0, 1500));
    expect_rows(file, 1500);
    table.append(rows_from(1500, 1000));
    expect_rows(file, 2500);
    const Hdf5Reader reader(file);
    EXPECT_EQ(reader.read_text_attribute("/x_m", "units"), "m");
    EXPECT_EQ(reader.read_text_attribute("/", "program_version"), "1");
  }

  TEST(Hdf5Table, GoesOnBehindTheRowsAskedFor)
  {
    const TemporaryFolder folder;
    const auto            file = folder.path / "table.h5";
    Hdf5Table::create(file, two_columns, {}).append(rows_from(0, 30));
    EXPECT_FALSE(Hdf5Table::reopen(file, two_columns, 31)); // they are not there
    EXPECT_FALSE(Hdf5Table::reopen(file, {{"y_m", {"m", "another"}}}, 10));
    EXPECT_FALSE(Hdf5Table::reopen(folder.path / "none.h5", two_columns, 0));
    auto table = Hdf5Table::reopen(file, two_columns, 20);
    ASSERT_TRUE(table);
    table->append(rows_from(20, 5));
    expect_rows(file, 25);
  }

  TEST(Hdf5Table, GrowsWhileAnotherProgramHoldsTheFile)
  {
    const TemporaryFolder folder;
    const auto            file  = folder.path / "table.h5";
    Hdf5Table             table = Hdf5Table::create(file, two_columns, {});
    table.append(rows_from(0, 10));
    const SharedLock another(file);
    table.append(rows_from(10, 10));
    expect_rows(file, 20);
    EXPECT_TRUE(Hdf5Table::reopen(file, two_columns, 15));
    expect_rows(file, 15);
  }
} // namespace swimtwin
