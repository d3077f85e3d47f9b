#include <datasets/files/earlier_results.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    const WrittenFiles earlier_run{"simulate", {"summary.json", "fields/tail-[0-9]*.vtu"}, "", ""};

    class EarlierResultsTest : public testing::Test
    {
    protected:
      EarlierResultsTest()
      {
        folder.write("summary.json", "old");
        folder.write("notes.txt", "mine");
        fs::create_directories(folder.path / "fields");
        folder.write("fields/tail-0001.vtu", "old");
      }

      bool old_is_there() const
      {
        return content(folder.path / "summary.json") == "old" && content(folder.path / "fields/tail-0001.vtu") == "old";
      }

      TemporaryFolder folder;
    };
  } // namespace

  TEST_F(EarlierResultsTest, AreOutOfTheWayAndNothingElseIs)
  {
    EarlierResults earlier(folder.path, earlier_run);
    EXPECT_TRUE(earlier.are_aside());
    EXPECT_FALSE(fs::exists(folder.path / "summary.json"));
    EXPECT_FALSE(fs::exists(folder.path / "fields"));
    EXPECT_EQ(content(folder.path / "notes.txt"), "mine");
    earlier.drop();
    EXPECT_EQ(n_files(folder.path), 1u);
  }

  TEST_F(EarlierResultsTest, ComeBackIfTheNewRunWroteNothing)
  {
    EarlierResults earlier(folder.path, earlier_run);
    EXPECT_TRUE(earlier.restore_or_drop());
    EXPECT_TRUE(old_is_there());
    EXPECT_EQ(n_files(folder.path), 3u);
  }

  TEST_F(EarlierResultsTest, DoNotComeBackBesideNewOnes)
  {
    EarlierResults earlier(folder.path, earlier_run);
    folder.write("summary.json", "new");
    EXPECT_FALSE(earlier.restore_or_drop());
    EXPECT_EQ(content(folder.path / "summary.json"), "new");
    EXPECT_EQ(n_files(folder.path), 2u);
  }

  TEST_F(EarlierResultsTest, KeepTheFolderThatHoldsSomethingOfTheUser)
  {
    folder.write("fields/view.pvsm", "mine");
    EarlierResults earlier(folder.path, earlier_run);
    EXPECT_EQ(content(folder.path / "fields/view.pvsm"), "mine");
    EXPECT_TRUE(earlier.restore_or_drop());
    EXPECT_TRUE(old_is_there());
  }

  TEST_F(EarlierResultsTest, OfAKilledRunAreSettledByTheNext)
  {
    {
      EarlierResults killed(folder.path, earlier_run);
    }
    ASSERT_FALSE(fs::exists(folder.path / "summary.json"));
    settle_earlier_results(folder.path, {earlier_run});
    EXPECT_TRUE(old_is_there());

    EarlierResults killed_later(folder.path, earlier_run);
    folder.write("summary.json", "new");
    settle_earlier_results(folder.path, {earlier_run});
    EXPECT_EQ(content(folder.path / "summary.json"), "new");
    EXPECT_EQ(n_files(folder.path), 2u);
  }

  TEST_F(EarlierResultsTest, LeaveWhatPicturesOfOtherVerbsNeed)
  {
    const WrittenFiles drawn_run{
        "simulate", {"pictures/style.gp", "pictures/shapes.gp"}, "", "", "pictures/style.gp", {"pictures/*.gp"}};
    fs::create_directories(folder.path / "pictures");
    for (const char *file : {"pictures/style.gp", "pictures/shapes.gp", "pictures/fit.gp"})
      folder.write(file, "old");
    EarlierResults earlier(folder.path, drawn_run);
    EXPECT_FALSE(fs::exists(folder.path / "pictures/shapes.gp"));
    EXPECT_EQ(content(folder.path / "pictures/style.gp"), "old");
    EXPECT_TRUE(earlier.restore_or_drop());
    EXPECT_EQ(content(folder.path / "pictures/shapes.gp"), "old");

    fs::remove(folder.path / "pictures/fit.gp");
    EarlierResults all(folder.path, drawn_run);
    EXPECT_FALSE(fs::exists(folder.path / "pictures"));
  }

  // Some are aside and some still in place.
  TEST_F(EarlierResultsTest, OfARunThatWasKilledWhileTheyMovedComeBack)
  {
    fs::create_directory(folder.path / ".swimtwin-before-simulate.moving");
    fs::rename(folder.path / "summary.json", folder.path / ".swimtwin-before-simulate.moving" / "summary.json");
    settle_earlier_results(folder.path, {earlier_run});
    EXPECT_TRUE(old_is_there());
    EXPECT_EQ(n_files(folder.path), 3u);
  }
} // namespace swimtwin
