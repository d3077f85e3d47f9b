#include <datasets/text/csv_table.h>
#include <datasets/text/csv_writer.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>
#include <limits>
#include <random>

namespace swimtwin
{
  namespace
  {
    std::string row_of(const std::string &text)
    {
      CsvWriter table({"a", "b"});
      table.cell(text).cell(1).end_row();
      return table.text().substr(4);
    }
  } // namespace

  TEST(CsvWriter, TheHeaderIsTheFirstLineAndNoRow)
  {
    const CsvWriter table({"time_s", "a, b"});
    EXPECT_EQ(table.text(), "time_s,\"a, b\"\n");
    EXPECT_EQ(table.n_rows(), 0u);
  }

  TEST(CsvWriter, NumbersAreShortAndMissingOnesEmpty)
  {
    CsvWriter table({"a", "b", "c", "d", "e", "f"});
    table.cell(0.3).cell(1. / 3.).cell(200000.).cell(-1e-7).cell(std::nan("")).cell(std::optional<double>()).end_row();
    table.cell(std::numeric_limits<double>::infinity()).cell(-3).cell(7ul).cell(true).cell(0.).cell("").end_row();
    EXPECT_EQ(table.text(), "a,b,c,d,e,f\n0.3,0.3333333333333333,200000,-1e-07,,\n,-3,7,1,0,\n");
    EXPECT_EQ(table.n_rows(), 2u);
  }

  TEST(CsvWriter, NumbersReadBackTheSameToTheLastBit)
  {
    std::mt19937_64                  random(1);
    std::uniform_real_distribution<> exponent(-300., 300.);
    std::vector<double> written = {5e-324, std::numeric_limits<double>::max(), -0., 1e23, 9007199254740993.};
    for (int i = 0; i < 1000; ++i)
      written.push_back(std::pow(10., exponent(random)));
    CsvWriter table({"x"});
    for (const double value : written)
      table.cell(value).end_row();
    const TemporaryFolder folder;
    table.save(folder.path / "x.csv");
    EXPECT_EQ(CsvTable::read(folder.path / "x.csv").column("x"), written);
  }

  TEST(CsvWriter, TextsAreQuotedWhereSeparatorsQuotesCommentsOrBlanksAskForIt)
  {
    EXPECT_EQ(row_of("plain; text"), "plain; text,1\n");
    EXPECT_EQ(row_of("a, b"), "\"a, b\",1\n");
    EXPECT_EQ(row_of("so \"called\""), "\"so \"\"called\"\"\",1\n");
    EXPECT_EQ(row_of("# 3"), "\"# 3\",1\n");
    EXPECT_EQ(row_of(" a "), "\" a \",1\n");
  }

  TEST(CsvWriter, ARowStaysALineOfText)
  {
    EXPECT_EQ(row_of("one\r\ntwo\tthree"), "one  two three,1\n");
    EXPECT_EQ(row_of("µ"), "µ,1\n");
    EXPECT_EQ(row_of("\xb5m"), "\xEF\xBF\xBDm,1\n"); // Latin-1
  }
} // namespace swimtwin
