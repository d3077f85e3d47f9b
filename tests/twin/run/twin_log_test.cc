#include <tests/datasets/temporary_folder.h>
#include <tests/twin/run/log_check.h>
#include <twin/run/twin_log.h>
#include <twin/run/twin_rows.h>

namespace swimtwin
{
  namespace
  {
    const std::vector<TableColumn> columns = {{"time_s", {"s", "instant"}},
                                              {"seen_m", {"m", "where it was seen"}},
                                              {flags_column, {"", ""}},
                                              {"line", {"1", ""}}};
    const Provenance               provenance{"swimtwin 0", "swimtwin twin", "", "", "2026-01-01T00:00:00Z", 0.};

    /// Nothing is seen at every third, and flags come and go.
    std::string row(const int i)
    {
      return fmt::format("{},{},{},{}", 0.1 * i, i % 3 == 0 ? "" : fmt::format("{}", 1e-3 * i),
                         i % 2 == 0   ? "near-wall;frozen"
                         : i % 5 == 0 ? "step-out"
                                      : "",
                         i);
    }

    std::vector<std::string> rows_from(const int first, const int n)
    {
      std::vector<std::string> rows;
      for (int i = first; i < first + n; ++i)
        rows.push_back(row(i));
      return rows;
    }

    class TwinLogTest : public ::testing::Test
    {
    protected:
      /// As the twin's folder does: the table at once, the log in blocks.
      void add(TwinLog &log, const int first, const int n) const
      {
        std::ofstream                  out(csv, std::ios::app);
        const std::vector<std::string> rows = rows_from(first, n);
        for (const std::string &line : rows)
          out << line << '\n';
        log.append(rows);
      }

      const TemporaryFolder       folder;
      const std::filesystem::path csv = folder.path / "twin.csv", file = folder.path / "twin.h5";

      void SetUp() override { std::ofstream(csv) << header_of(columns) << '\n'; }
    };
  } // namespace

  TEST_F(TwinLogTest, SaysWhatTheTableSays)
  {
    TwinLog log(file, columns);
    log.begin(provenance);
    add(log, 0, 30);
    add(log, 30, 7);
    expect_log_as_table(file, csv);
    const Hdf5Reader reader(file);
    EXPECT_EQ(reader.read_vector("/flag_step-out").at(5), 1.);
    EXPECT_EQ(reader.read_vector("/flag_step-out").at(6), 0.);
    EXPECT_EQ(reader.read_text_attribute("/", "command_line"), "swimtwin twin");
  }

  TEST_F(TwinLogTest, GoesOnBehindTheStateWhateverTheKillLeft)
  {
    TwinLog log(file, columns);
    log.begin(provenance);
    add(log, 0, 30);
    // The state was saved behind 20 rows: the log has more.
    TwinLog ahead(file, columns);
    ahead.resume(csv, 20, provenance);
    ahead.append(rows_from(20, 10));
    expect_log_as_table(file, csv);
    // It has fewer, or it is no table, or it is gone: the rows come from the other table.
    TwinLog unwritten(file, columns), behind(file, columns);
    add(unwritten, 30, 10);
    behind.resume(csv, 35, provenance);
    behind.append(rows_from(35, 5));
    expect_log_as_table(file, csv);
    for (const bool is_there : {true, false})
    {
      std::filesystem::remove(file);
      if (is_there)
        std::ofstream(file) << "no HDF5";
      TwinLog anew(file, columns);
      anew.resume(csv, 40, provenance);
      expect_log_as_table(file, csv);
    }
  }

  TEST_F(TwinLogTest, ThatCannotBeWrittenStopsNobody)
  {
    std::filesystem::create_directory(file);
    TwinLog log(file, columns);
    log.begin(provenance);
    add(log, 0, 10);
  }
} // namespace swimtwin
