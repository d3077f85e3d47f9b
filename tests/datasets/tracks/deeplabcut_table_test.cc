#include <datasets/tracks/deeplabcut_table.h>
#include <tests/datasets/temporary_folder.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    const std::string labels = "scorer,DLC_net,DLC_net,DLC_net,DLC_net,DLC_net,DLC_net\n"
                               "bodyparts,head,head,head,tail,tail,tail\n"
                               "coords,x,y,likelihood,x,y,likelihood\n";

    std::string frames(const std::string &likelihood_of_second = "0.99")
    {
      std::string rows;
      for (int i = 0; i < 6; ++i)
        rows += fmt::format("{},{},10,{},{},12,0.2\n", i, 100. - i, i == 1 ? likelihood_of_second : "0.99", 200. - i);
      return rows;
    }

    Camera calibrated()
    {
      Camera camera;
      camera.pixel_m = 5e-6;
      camera.frame_s = 0.04;
      return camera;
    }

    struct Reading
    {
      std::vector<HeadTrack> tracks;
      DataProblems           problems;

      std::string problem() const { return problems.all().empty() ? "" : problems.all().front().text; }
    };

    Reading read_film(const std::string &text, const Camera &camera, const std::string &part,
                      const std::string &individual = "")
    {
      const TemporaryFolder folder;
      Reading               result;
      Recording             recording{"film.csv", 0.5, 0., {}, "side.toml:9", part, individual};
      const CsvTable        table = CsvTable::read(folder.write("film.csv", text));
      EXPECT_TRUE(is_deeplabcut_table(table));
      result.tracks = deeplabcut_track(table, recording, camera, result.problems);
      return result;
    }
  } // namespace

  TEST(DeeplabcutTable, ReadsTheBodyPartThatIsAskedFor)
  {
    const Reading head = read_film(labels + frames(), calibrated(), "head");
    EXPECT_EQ(head.problem(), "");
    ASSERT_EQ(head.tracks.at(0).x_m.size(), 6u);
    EXPECT_DOUBLE_EQ(head.tracks[0].x_m[2], 98. * 5e-6);
    EXPECT_DOUBLE_EQ(head.tracks[0].time_s[2], 0.08);
    expect_in(read_film(labels + frames(), calibrated(), "").problem(),
              "DeepLabCut followed head, tail; choose the head in the sidecar, body_part");
    expect_in(read_film(labels + frames(), calibrated(), "nose").problem(),
              "side.toml:9: body_part = \"nose\" is not in film.csv, which has head, tail.");
  }

  TEST(DeeplabcutTable, LeavesOutWhatTheNetworkIsNotSureOf)
  {
    const Reading unsure = read_film(labels + frames("0.3"), calibrated(), "head");
    ASSERT_EQ(unsure.tracks.at(0).x_m.size(), 5u);
    EXPECT_DOUBLE_EQ(unsure.tracks[0].time_s[1], 0.08);
    expect_in(unsure.problem(), "1 of 6 frames are left out because their likelihood is below 0.6");
    Camera bold           = calibrated();
    bold.least_likelihood = 0.1;
    EXPECT_EQ(read_film(labels + frames("0.3"), bold, "tail").tracks.at(0).x_m.size(), 6u);
    expect_in(read_film(labels + frames(), calibrated(), "tail").problem(),
              "none of 6 frames has a likelihood of at least 0.6");
  }

  TEST(DeeplabcutTable, AsksForTheSizeOfAPixelAndTheFrameInterval)
  {
    const Reading result = read_film(labels + frames(), {}, "head");
    expect_in(result.problem(), "give the size of one in the sidecar, [camera] pixel_m");
    expect_in(result.problems.all().at(1).text, "give the time between two in the sidecar, [camera] frame_s");
  }

  TEST(DeeplabcutTable, RefusesTwoUnitsOfItsPositions)
  {
    Camera camera      = calibrated();
    camera.length_unit = "um";
    const Reading both = read_film(labels + frames(), camera, "head");
    EXPECT_TRUE(both.tracks.empty());
    expect_in(both.problem(), "film.csv:1: the positions are in pixels of 5e-06 m by [camera] pixel_m of the sidecar, "
                              "but in \"um\" by its length_unit; keep pixel_m alone");
    camera.pixel_m.reset();
    EXPECT_DOUBLE_EQ(read_film(labels + frames(), camera, "head").tracks.at(0).x_m[2], 98e-6);
    camera             = calibrated();
    camera.length_unit = "pixel";
    EXPECT_DOUBLE_EQ(read_film(labels + frames(), camera, "head").tracks.at(0).x_m[2], 98. * 5e-6);
  }

  TEST(DeeplabcutTable, TellsIndividualsApart)
  {
    const std::string two =
        "scorer,n,n,n,n,n,n\nindividuals,a,a,a,b,b,b\nbodyparts,head,head,head,head,head,head\n"
        "coords,x,y,likelihood,x,y,likelihood\n0,1,2,0.9,3,4,0.9\n1,1,2,0.9,,,\n2,1,2,0.9,5,6,0.9\n";
    expect_in(read_film(two, calibrated(), "head").problem(), "DeepLabCut followed head of a, head of b; choose");
    const Reading b = read_film(two, calibrated(), "head", "b");
    EXPECT_EQ(b.tracks.at(0).x_m.size(), 2u);
    expect_in(b.problem(), "1 of 3 frames are left out");
  }
} // namespace swimtwin
