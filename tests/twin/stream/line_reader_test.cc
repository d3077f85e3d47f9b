#include <twin/stream/line_reader.h>

#include <gtest/gtest.h>

#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    class LineReaderTest : public testing::Test
    {
    protected:
      LineReaderTest() { EXPECT_EQ(::pipe(ends), 0); }
      ~LineReaderTest() override
      {
        close_writer();
        ::close(ends[0]);
      }
      void write(const std::string &text)
      {
        EXPECT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
      }
      void close_writer()
      {
        if (ends[1] >= 0)
          ::close(ends[1]);
        ends[1] = -1;
      }
      int         ends[2] = {-1, -1};
      std::string line;
    };

    TEST_F(LineReaderTest, GivesLinesWholeHoweverTheyCome)
    {
      LineReader reader(ends[0]);
      write("one\ntw");
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::line);
      EXPECT_EQ(line, "one");
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::nothing);
      write("o\n\nthree");
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::line);
      EXPECT_EQ(line, "two");
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::line);
      EXPECT_EQ(line, "");
      close_writer();
      EXPECT_EQ(reader.next(line, 100), LineReader::Got::line);
      EXPECT_EQ(line, "three");
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::end);
    }

    TEST_F(LineReaderTest, ThrowsLongLinesAwayAndGoesOn)
    {
      LineReader        reader(ends[0]);
      const std::string piece(30000, 'x');
      write(piece);
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::nothing);
      write(piece);
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::nothing);
      write(piece);
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::nothing);
      write("end\nnext\n");
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::too_long);
      EXPECT_EQ(reader.next(line, 0), LineReader::Got::line);
      EXPECT_EQ(line, "next");
    }
  } // namespace
} // namespace swimtwin
