#include <reports/page/gnuplot.h>

#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace
  {
    GnuplotPicture example_picture(const std::string_view script)
    {
      GnuplotPicture picture;
      picture.name   = "example";
      picture.script = script;
      picture.set_text("heading", "what's b_y^2 {in} mT?");
      picture.set_text("caption", "");
      picture.table.begin_block("x, y");
      picture.table.add_row({0., 1.});
      picture.table.add_row({1., -2.5e-3});
      picture.table.begin_block("x, y");
      picture.table.add_row({2., 3.});
      return picture;
    }
  } // namespace

  TEST(GnuplotTable, BlocksAreWhatIndexCounts)
  {
    EXPECT_EQ(example_picture("").table.text(), "# x, y\n0 1\n1 -0.0025\n\n\n# x, y\n2 3\n");
  }

  TEST(GnuplotTable, ABlockWithoutRowsIsCounted)
  {
    GnuplotTable table;
    table.begin_block("a");
    table.begin_block("b");
    table.add_row({1., 2.});
    table.begin_block("c");
    EXPECT_EQ(table.text(), "# a\nNaN NaN NaN NaN\n\n\n# b\n1 2\n\n\n# c\nNaN NaN NaN NaN\n");
  }

  TEST(GnuplotPicture, TextIsShownAsItIs)
  {
    EXPECT_EQ(example_picture("").variables.front().second, R"('what''s b\_y\^2 \{in\} mT?')");
  }

  TEST(GnuplotPicture, NumbersNeverDivideAsIntegers)
  {
    GnuplotPicture picture;
    picture.set("one", 1.);
    EXPECT_NE(picture.variables.front().second.find('.'), std::string::npos);
  }

  TEST(GnuplotFiles, OriginStaysOneCommentLine)
  {
    const TemporaryFolder folder;
    write_gnuplot_files(folder.path, example_picture("plot data\n"), "scene a\nexit");
    expect_in(content(folder.path / "example.gp"), "# scene a exit\n");
    expect_in(content(folder.path / "example.dat"), "# scene a exit\n# x, y\n");
    EXPECT_EQ(n_files(folder.path), 3u);
  }

  TEST(GnuplotFiles, PictureIsAPngAndNothingElseIsLeft)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    write_gnuplot_files(folder.path, example_picture("plot data index 0 with lines\n"), "test");
    const auto png = draw_png(folder.path, "example");
    EXPECT_EQ(png, folder.path / "example.png");
    EXPECT_EQ(content(png).substr(0, 4), "\x89PNG");
    EXPECT_EQ(n_files(folder.path), 4u);
  }

  TEST(GnuplotFiles, FailureTellsWhatGnuplotSaidAndLeavesNoPicture)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    write_gnuplot_files(folder.path, example_picture("plot no_such_variable\n"), "test");
    const std::string message = message_of<ComputationError>([&] { draw_png(folder.path, "example"); });
    expect_in(message, "no_such_variable");
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_EQ(n_files(folder.path), 3u);
  }
} // namespace swimtwin
