#include <datasets/system/error.h>
#include <datasets/tracks/trackmate_table.h>
#include <tests/datasets/example_observations.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    // The header rows that TrackMate 7 writes.
    const std::string keys =
        "LABEL,ID,TRACK_ID,QUALITY,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME,RADIUS,VISIBILITY\n";
    const std::string names   = "Label,Spot ID,Track ID,Quality,X,Y,Z,T,Frame,Radius,Visibility\n"
                                "Label,Spot ID,Track ID,Quality,X,Y,Z,T,Frame,R,Visibility\n";
    const std::string microns = ",,,(quality),(micron),(micron),(micron),(sec),,(micron),\n";
    const std::string pixels  = ",,,(quality),(pixel),(pixel),(pixel),(frame),,(pixel),\n";

    std::string spot(const int frame, const std::string &track, const double x, const double interval = 0.04)
    {
      return fmt::format("ID{0},{0},{1},7.5,{2},{3},0.0,{4},{0},2.5,1\n", frame, track, x, 10. + x, interval * frame);
    }

    std::string spots(const std::string &track, const int n = 5)
    {
      std::string rows;
      for (int frame = 0; frame < n; ++frame)
        rows += spot(frame, track, 100. - 2. * frame);
      return rows;
    }

    struct Import
    {
      std::vector<HeadTrack> tracks;
      DataProblems           problems;
    };

    Import import(const std::string &text, const Camera &camera = {}, const std::vector<int> &track_ids = {})
    {
      const TemporaryFolder folder;
      Import                result;
      const Recording       recording{"spots.csv", 0.5, 0., track_ids, "side.toml:12"};
      result.tracks =
          trackmate_track(CsvTable::read(folder.write("spots.csv", text)), recording, camera, result.problems);
      return result;
    }

    std::string problem(const Import &import)
    {
      return import.problems.all().empty() ? "" : import.problems.all().front().text;
    }
  } // namespace

  TEST(TrackmateTable, ReadsSpotsInMicronsAndSeconds)
  {
    const Import result = import(keys + names + microns + spots("3"));
    EXPECT_EQ(problem(result), "");
    ASSERT_EQ(result.tracks.size(), 1u);
    EXPECT_EQ(result.tracks[0].frequency_Hz, 0.5);
    ASSERT_EQ(result.tracks[0].time_s.size(), 5u);
    EXPECT_DOUBLE_EQ(result.tracks[0].time_s[4], 0.16);
    EXPECT_DOUBLE_EQ(result.tracks[0].x_m[4], 92e-6);
    EXPECT_DOUBLE_EQ(result.tracks[0].y_m[4], 102e-6);
  }

  TEST(TrackmateTable, ConvertsPixelsAndFrames)
  {
    Camera camera;
    camera.pixel_m      = 5e-6;
    camera.frame_s      = 0.02;
    const Import result = import(keys + names + pixels + spots("0"), camera);
    EXPECT_EQ(problem(result), "");
    EXPECT_DOUBLE_EQ(result.tracks[0].x_m[1], 490e-6);
    EXPECT_DOUBLE_EQ(result.tracks[0].time_s[1], 0.02);
  }

  TEST(TrackmateTable, AsksForPixelSizeAndFrameInterval)
  {
    const Import result = import(keys + names + pixels + spots("0"));
    EXPECT_TRUE(result.tracks.empty());
    expect_in(problem(result),
              "spots.csv:1: POSITION_X is in pixels; give the size of one in the sidecar, [camera] pixel_m.");
    expect_in(result.problems.all()[1].text, "POSITION_T is in \"frame\"; give the time between two frames");
  }

  TEST(TrackmateTable, AsksForTheUnitWithoutARowOfUnits)
  {
    EXPECT_TRUE(import(keys + spots("0")).tracks.empty());
    expect_in(problem(import(keys + spots("0"))), "an unknown unit (there is no row of units); give it in the sidecar, "
                                                  "[camera] length_unit = \"um\"");
    Camera camera;
    camera.pixel_m = 1e-6;
    camera.frame_s = 0.04;
    expect_in(problem(import(keys + spots("0"), camera)), "pixel_m alone does not say that it is pixels");
    camera.length_unit = "pixel";
    EXPECT_DOUBLE_EQ(import(keys + spots("0"), camera).tracks.at(0).x_m[1], 98e-6);
    camera.pixel_m.reset();
    camera.length_unit = "mm";
    EXPECT_DOUBLE_EQ(import(keys + spots("0"), camera).tracks.at(0).x_m[1], 98e-3);
    camera.frame_s.reset();
    camera.time_unit = "min";
    EXPECT_DOUBLE_EQ(import(keys + spots("0"), camera).tracks.at(0).time_s[1], 2.4);
  }

  TEST(TrackmateTable, FindsTheRowOfUnitsWhereverItStands)
  {
    for (const std::string &between : {std::string(), names, names + names})
      EXPECT_DOUBLE_EQ(import(keys + between + microns + spots("0")).tracks.at(0).x_m[1], 98e-6);
    EXPECT_DOUBLE_EQ(import(keys + microns + names + spots("0")).tracks.at(0).x_m[1], 98e-6);
  }

  TEST(TrackmateTable, FindsTheRowOfUnitsWhereASpreadsheetHasSortedItTo)
  {
    Camera in_mm;
    in_mm.length_unit = "mm";
    for (const std::string &sunk : {spots("0") + microns, spot(0, "0", 100.) + names + microns + spot(1, "0", 98.)})
    {
      const Import result = import(keys + sunk);
      EXPECT_EQ(problem(result), "");
      EXPECT_DOUBLE_EQ(result.tracks.at(0).x_m.at(1), 98e-6);
      EXPECT_DOUBLE_EQ(result.tracks[0].time_s[1], 0.04);
      expect_in(problem(import(keys + sunk, in_mm)),
                "is in \"micron\", but [camera] length_unit of the sidecar is \"mm\"");
    }
    expect_in(problem(import(keys + microns + spots("0") + pixels)), "the positions are in \"pixel\" here and in ");
  }

  TEST(TrackmateTable, FindsItsKeysBelowOtherLines)
  {
    const TemporaryFolder folder;
    const CsvTable        table = CsvTable::read(folder.write("spots.csv", microns + keys + spots("0")));
    EXPECT_FALSE(is_trackmate_table(table));
    EXPECT_EQ(table.line(find_row_of_keys(table).value()), 2u);
  }

  TEST(TrackmateTable, AsksForTheFrameIntervalWhereTimeStandsStill)
  {
    std::string still;
    for (int frame = 0; frame < 5; ++frame)
      still += spot(frame, "0", 100. - frame, 0.);
    const Import result = import(keys + microns + still);
    ASSERT_EQ(result.problems.all().size(), 1u);
    expect_in(problem(result),
              "spots.csv:3: POSITION_T is 0 in all 5 spots, so it tells no time; give the time between "
              "two frames in the sidecar, [camera] frame_s");
    Camera camera;
    camera.frame_s = 0.04;
    EXPECT_EQ(import(keys + microns + still, camera).tracks.size(), 1u);
  }

  TEST(TrackmateTable, SaysOnceThatTracksHaveNoNumbers)
  {
    const Import result = import(keys + microns + spots("Track_0"));
    ASSERT_EQ(result.problems.all().size(), 1u);
    expect_in(problem(result), "TRACK_ID (column 3) = \"Track_0\" is no number of a track");
  }

  TEST(TrackmateTable, DoesNotTakeSpotsWithoutAPositionForHeaderRows)
  {
    const std::string broken  = "ID9,9,0,7.5,gone,gone,0.0,gone,gone,2.5,1\n",
                      nowhere = "ID9,9,,7.5,NaN,NaN,0,NaN,,2.5,1\n";
    expect_in(problem(import(keys + microns + spots("0") + broken)), "\"gone\" is not a finite number");
    EXPECT_EQ(problem(import(keys + microns + spots("0") + nowhere)), "");
  }

  TEST(TrackmateTable, FindsUnitsInTheHeader)
  {
    const std::string header =
        "Label,Spot ID,Track ID,Quality,X (\u00B5m),Y (\u00B5m),Z (\u00B5m),T (ms),Frame,R,Visibility\n";
    const Import result = import(header + spots("0"));
    EXPECT_EQ(problem(result), "");
    EXPECT_DOUBLE_EQ(result.tracks.at(0).x_m[1], 98e-6);
    EXPECT_DOUBLE_EQ(result.tracks.at(0).time_s[1], 0.04e-3);
  }

  TEST(TrackmateTable, RefusesUnitsThatContradictEachOther)
  {
    const std::string mixed = ",,,(quality),(micron),(mm),(micron),(sec),,(micron),\n";
    expect_in(problem(import(keys + names + mixed + spots("0"))),
              "spots.csv:4: the positions are in \"mm\" here and in \"micron\" at ");
    Camera camera;
    camera.length_unit = "mm";
    expect_in(problem(import(keys + names + microns + spots("0"), camera)),
              "is in \"micron\", but [camera] length_unit of the sidecar is \"mm\"");
    camera.length_unit = "um";
    EXPECT_EQ(problem(import(keys + names + microns + spots("0"), camera)), "");
  }

  TEST(TrackmateTable, KnowsADamagedSignForMicro)
  {
    for (const char *unit : {"(\u00C2\u00B5m)", "(\u00E6m)", "(?m)", "(\\u00B5m)"})
      expect_in(
          problem(import(keys + names + replaced(replaced(microns, "(micron)", unit), "(micron)", unit) + spots("0"))),
          "where the sign for micro was damaged on the way; write (um), or save the table as UTF-8.");
    expect_in(
        problem(
            import(keys + names + replaced(replaced(microns, "(micron)", "(ell)"), "(micron)", "(ell)") + spots("0"))),
        "\"ell\", which is not a known unit of length; set the unit of the images in Fiji (Image > Properties), or "
        "write the one that it is, such as (um), or (pixel) if the numbers are pixels");
  }

  TEST(TrackmateTable, ReadsWhatImageJSaves)
  {
    std::string text = " \tLabel\tTRACK_ID\tPOSITION_X\tPOSITION_Y\tPOSITION_T\tFRAME\n";
    for (int frame = 0; frame < 5; ++frame)
      text += fmt::format("{}\tID{}\t2\t{}\t7\t{}\t{}\n", frame + 1, frame, 100 - frame, 0.5 * frame, frame);
    Camera camera;
    camera.length_unit  = "um";
    camera.time_unit    = "s";
    const Import result = import(text, camera);
    EXPECT_EQ(problem(result), "");
    EXPECT_DOUBLE_EQ(result.tracks.at(0).x_m[4], 96e-6);
    EXPECT_DOUBLE_EQ(result.tracks.at(0).time_s[4], 2.);
  }

  TEST(TrackmateTable, ReadsOtherTrackers)
  {
    Camera camera;
    camera.length_unit   = "pixel";
    camera.pixel_m       = 1e-6;
    camera.frame_s       = 0.1;
    const Import trackpy = import(",y,x,mass,frame,particle\n0,5,10,1,0,3\n1,5,11,1,1,3\n", camera);
    EXPECT_EQ(problem(trackpy), "");
    EXPECT_DOUBLE_EQ(trackpy.tracks.at(0).x_m[1], 11e-6);
    EXPECT_DOUBLE_EQ(trackpy.tracks.at(0).time_s[1], 0.1);
    const Import mtrackj = import("Nr\tTID\tPID\tx [mm]\ty [mm]\tt [sec]\n1\t1\t1\t2\t0\t0\n2\t1\t2\t3\t0\t0.5\n");
    EXPECT_EQ(problem(mtrackj), "");
    EXPECT_DOUBLE_EQ(mtrackj.tracks.at(0).x_m[1], 3e-3);
    EXPECT_DOUBLE_EQ(mtrackj.tracks.at(0).time_s[1], 0.5);
  }

  TEST(TrackmateTable, WarnsOfAnotherFrameInterval)
  {
    Camera camera;
    camera.frame_s = 0.02;
    expect_in(problem(import(keys + names + microns + spots("0"), camera)),
              "POSITION_T says 0.04 s between two frames, [camera] frame_s of the sidecar 0.02 s");
    camera.frame_s = 0.04;
    EXPECT_EQ(problem(import(keys + names + microns + spots("0"), camera)), "");
  }

  TEST(TrackmateTable, SortsByTimeAndLeavesOutSpotsOutsideTheTracks)
  {
    const Import result =
        import(keys + names + microns + spot(3, "1", 7.) + spot(2, "", 500.) + spot(1, "1", 5.) + spot(2, "1", 6.));
    EXPECT_EQ(problem(result), "");
    ASSERT_EQ(result.tracks[0].x_m.size(), 3u);
    EXPECT_DOUBLE_EQ(result.tracks[0].x_m[0], 5e-6);
    EXPECT_DOUBLE_EQ(result.tracks[0].x_m[2], 7e-6);
  }

  TEST(TrackmateTable, AsksWhichOfSeveralTracks)
  {
    const std::string text = keys + names + microns + spots("0") + spots("4", 7);
    expect_in(problem(import(text)),
              "there are 2 tracks: 0 (5 spots), 4 (7 spots); choose one in the sidecar, track_id");
    EXPECT_EQ(import(text, {}, {4}).tracks[0].x_m.size(), 7u);
    expect_in(problem(import(text, {}, {5})),
              "side.toml:12: track_id = 5 is not in spots.csv, which has 0 (5 spots), 4 (7");
    expect_in(problem(import(keys + names + microns + spots(""))), "no spot belongs to a track");
  }

  TEST(TrackmateTable, JoinsThePiecesOfOneSwimmer)
  {
    const auto piece = [](const std::string &track, const int first, const int last, const double offset = 0.) {
      std::string rows;
      for (int frame = first; frame <= last; ++frame)
        rows += spot(frame, track, 100. - 2. * frame + offset);
      return rows;
    };
    const std::string head   = keys + names + microns;
    const Import      joined = import(head + piece("3", 6, 9) + piece("0", 0, 4), {}, {3, 0});
    EXPECT_EQ(problem(joined), "");
    ASSERT_EQ(joined.tracks.at(0).x_m.size(), 9u);
    EXPECT_DOUBLE_EQ(joined.tracks[0].x_m[5], 88e-6);
    expect_in(
        problem(import(head + piece("0", 0, 5) + piece("3", 4, 9), {}, {0, 3})),
        "side.toml:12: tracks 0 and 3 of spots.csv overlap, POSITION_T 0.16 to 0.2; two spots at once are not one");
    expect_in(problem(import(head + piece("0", 0, 4) + piece("3", 6, 9, 500.), {}, {0, 3})),
              "between tracks 0 and 3 of spots.csv the spot jumps");
    expect_in(problem(import(head + piece("0", 0, 4) + piece("3", 6, 9), {}, {0, 4})), "track_id = 4 is not in");
    expect_in(problem(import(head + piece("0", 0, 4) + piece("3", 6, 9))), "pieces of one swimmer, track_id = [0, 3]");
  }

  TEST(TrackmateTable, RefusesWhatItCannotRead)
  {
    expect_in(problem(import("LABEL,TRACK_ID,SPEED\n")),
              "the column POSITION_X is missing; export the spots of the tracks");
    expect_in(problem(import(keys + names + ",,,(quality),(furlong),(furlong),,(sec),,,\n" + spots("0"))),
              "spots.csv:4: POSITION_X is in \"furlong\", which is not a known unit of length");
    expect_in(
        problem(import(keys + names + microns + spots("0") + spot(2, "0", 3.))),
        "spots.csv:10: POSITION_T (column 8) = \"0.08\" stands already on line 7: the track splits or merges there");
    expect_in(problem(import(keys + names + microns + spots("0") + "ID9,9,0,1,oops,1,0,0.5,9,1,1\n")),
              "POSITION_X (column 5) = \"oops\" is not a finite number");
  }

  TEST(TrackmateTable, WarnsOfACalibrationThatIsNotUsedOrMissing)
  {
    Camera camera;
    camera.pixel_m = 1e-6;
    expect_in(problem(import(keys + names + microns + spots("0"), camera)),
              "POSITION_X is in micron already; [camera] pixel_m");
    std::string rows;
    for (int frame = 0; frame < 4; ++frame)
      rows += spot(frame, "0", frame, 1.);
    expect_in(problem(import(keys + names + microns + rows)),
              "POSITION_T equals FRAME, one frame per second: if the images");
  }

  TEST(TrackmateTable, IsOneOfTheRecordingsOfASet)
  {
    const std::string sidecar = example_sidecar + "[camera]\nhead_first = [-1, 0]\nposition_sigma_m = 1e-6\n";
    expect_in(
        ObservationFiles(keys + names + microns + spots("0"), sidecar).message(),
        "data.csv:1: this is a table of TrackMate; name it in the sidecar with its frequency: [[recording]] file = "
        "\"data.csv\"");
  }
} // namespace swimtwin
