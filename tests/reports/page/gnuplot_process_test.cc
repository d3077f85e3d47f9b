#include <reports/page/draw_pictures.h>
#include <reports/page/gnuplot_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/environment_variable.h>

#include <chrono>
#include <thread>

namespace swimtwin
{
  namespace
  {
    namespace fs = std::filesystem;
    using Clock  = std::chrono::steady_clock;

    GnuplotPicture
    a_picture(const std::string_view script = "plot data index 0 with lines title sprintf('%.1f', 0.5)\n")
    {
      GnuplotPicture picture;
      picture.name   = "example";
      picture.script = script;
      picture.set_text("heading", "µ = 0.5");
      picture.set_text("caption", "");
      picture.table.begin_block("x, y");
      picture.table.add_row({0., 1.5});
      picture.table.add_row({1., -2.5e-3});
      return picture;
    }

    /// Bytes of the PNG; empty with a warning.
    std::string drawn(const fs::path &folder, std::string &warning, const GnuplotPicture &picture = a_picture())
    {
      const auto pictures = draw_pictures(folder, {picture}, "test", warning);
      return pictures.empty() ? "" : content(pictures.front());
    }

    /// A program of this text in place of gnuplot, while it lives.
    class FalseGnuplot
    {
    public:
      explicit FalseGnuplot(const std::string &text, const fs::perms permissions = fs::perms::owner_all)
          : program_(folder_.write("gnuplot", text)), path_("PATH", (folder_.path.string() + ":/usr/bin:/bin").c_str())
      {
        fs::permissions(program_, permissions);
      }

    private:
      const TemporaryFolder     folder_;
      const fs::path            program_;
      const EnvironmentVariable path_;
    };
  } // namespace

  TEST(GnuplotProcess, DrawsTheSameBytesWhateverTheUsersVariablesAndSettings)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    std::string           warning;
    const std::string     expected = drawn(folder.path / "plain", warning);
    ASSERT_EQ(warning, "");
    ASSERT_FALSE(expected.empty());

    const std::string hostile = "set terminal dumb\nset decimalsign ','\nset xrange [5:6]\nexit\n";
    folder.write(".gnuplot", hostile);
    fs::create_directories(folder.path / "pictures");
    folder.write("pictures/.gnuplot", hostile);
    fs::create_directories(folder.path / ".config/gnuplot");
    folder.write(".config/gnuplot/gnuplotrc", hostile);
    fs::create_directories(folder.path / ".config/fontconfig");
    folder.write(".config/fontconfig/fonts.conf",
                 "<?xml version=\"1.0\"?><fontconfig><match><edit name=\"family\" mode=\"assign\" binding=\"strong\">"
                 "<string>monospace</string></edit></match></fontconfig>");
    folder.write("style.gp", hostile);
    const std::string home = folder.path, config = folder.path / ".config";
    for (const auto &[name, value] :
         std::vector<std::pair<const char *, const char *>>{{"GNUTERM", "no-such-terminal"},
                                                            {"GNUPLOT_DEFAULT_GDFONT", "nowhere"},
                                                            {"GDFONTPATH", "/nowhere"},
                                                            {"GNUPLOT_FONTPATH", "/nowhere"},
                                                            {"GNUPLOT_LIB", home.c_str()},
                                                            {"FIT_LOG", "/nowhere/fit.log"},
                                                            {"GNUHELP", "/nowhere"},
                                                            {"HOME", home.c_str()},
                                                            {"HOME", nullptr},
                                                            {"XDG_CONFIG_HOME", config.c_str()},
                                                            {"FONTCONFIG_FILE", "/dev/null"},
                                                            {"FONTCONFIG_PATH", "/nowhere"},
                                                            {"LC_ALL", "de_DE.UTF-8"},
                                                            {"LC_NUMERIC", "de_DE.UTF-8"},
                                                            {"LANG", nullptr},
                                                            {"TERM", "no-such-terminal"},
                                                            {"DISPLAY", ":99"},
                                                            {"TMPDIR", "/nowhere"}})
    {
      const EnvironmentVariable variable(name, value);
      EXPECT_EQ(drawn(folder.path / "pictures", warning), expected) << name;
      EXPECT_EQ(warning, "") << name;
    }
  }

  TEST(GnuplotProcess, NoPathAtAllFindsTheSystemsGnuplot)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const EnvironmentVariable path("PATH", nullptr);
    EXPECT_FALSE(find_gnuplot_fault());
  }

  TEST(GnuplotProcess, OneThatHangsIsEndedWithAllThatItStarted)
  {
    const TemporaryFolder folder;
    const FalseGnuplot    program("#!/bin/sh\nsleep 30 & echo $! > '" + (folder.path / "child").string() + "'\nwait\n");
    const auto            start  = Clock::now();
    const ProcessResult   result = run_gnuplot("/", {}, std::chrono::seconds(3)); // for the file too
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(20));
    EXPECT_TRUE(result.found);
    EXPECT_FALSE(result.succeeded);
    EXPECT_EQ(result.messages, "it did not end within 3 s");
    const std::string child = content(folder.path / "child");
    ASSERT_FALSE(child.empty());
    const auto is_alive = [&] { // neither gone nor a zombie
      const std::string state = content("/proc/" + child.substr(0, child.find('\n')) + "/stat");
      return !state.empty() && state.find(") Z ") == std::string::npos;
    };
    while (is_alive() && Clock::now() - start < std::chrono::seconds(20))
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(is_alive());
  }

  TEST(GnuplotProcess, OneThatComplainsWithoutEndIsCutShort)
  {
    const FalseGnuplot  program("#!/bin/sh\nwhile :; do echo no and no again >&2; done\n");
    const ProcessResult result = run_gnuplot("/", {}, std::chrono::milliseconds(500));
    EXPECT_FALSE(result.succeeded);
  }

  TEST(GnuplotProcess, OneThatFailsIsNotCalledMissing)
  {
    const TemporaryFolder folder;
    std::string           warning;
    {
      const FalseGnuplot program("#!/bin/sh\necho 'libcaca.so.0: cannot open' >&2\nexit 127\n");
      EXPECT_EQ(drawn(folder.path, warning), "");
      expect_in(warning, "no pictures were drawn because `gnuplot --version` fails: libcaca.so.0: cannot open; put");
    }
    {
      const FalseGnuplot program("#!/bin/sh\nkill -SEGV $$\n");
      EXPECT_EQ(drawn(folder.path, warning), "");
      expect_in(warning, "`gnuplot --version` fails: it was ended by signal 11; put");
    }
    {
      const FalseGnuplot program("no program", fs::perms::owner_read);
      const auto         fault = find_gnuplot_fault(); // the shell's rule: the next one in PATH
      EXPECT_TRUE(!fault || fault->cause.find("not installed") != std::string::npos);
    }
  }

  TEST(GnuplotProcess, APictureThatFailsLeavesNoEarlierOne)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    std::string           warning;
    ASSERT_FALSE(drawn(folder.path, warning).empty());
    EXPECT_EQ(drawn(folder.path, warning, a_picture("plot no_such_variable\n")), "");
    expect_in(warning, "no_such_variable");
    EXPECT_FALSE(fs::exists(folder.path / "example.png"));

    ASSERT_FALSE(drawn(folder.path, warning).empty());
    const FalseGnuplot program("#!/bin/sh\n[ \"$2\" = --version ]\n");
    EXPECT_EQ(drawn(folder.path, warning), "");
    expect_in(warning, "gnuplot failed");
    EXPECT_FALSE(fs::exists(folder.path / "example.png"));
  }
} // namespace swimtwin
