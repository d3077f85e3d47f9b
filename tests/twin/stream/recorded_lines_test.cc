#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>
#include <twin/stream/line_reader.h>
#include <twin/stream/recorded_lines.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    TEST(RecordedLines, KnowWhetherTheyWereComputedWithoutInertia)
    {
      const std::string folder = std::string(places::source) + "/datasets/observations/";
      EXPECT_FALSE(recorded_with_inertia(folder + "synthetic-tracks.csv"));
      EXPECT_FALSE(recorded_with_inertia(folder + "synthetic-trackmate.toml"));
      EXPECT_TRUE(recorded_with_inertia("log-without-a-sidecar.csv"));
    }

    const std::string field   = "source = \"imagined\"\nsynthetic = true\nswimmer = \"s\"\nmeasured_by = \"m\"\n"
                                "period = \"periodic\"\nbody_length_m = 8e-3\n[field]\nbx_T = 4e-3\nby_T = 4e-3\n";
    const std::string sidecar = field + "[camera]\nhead_first = [-1, 0]\nposition_sigma_m = 1e-5\n";

    /// A recording, line by line; times and places of the frames, and the sentences about wrong rows.
    struct Played
    {
      RecordedStream           stream;
      std::vector<double>      time_s, x_m;
      std::vector<std::string> faults;

      explicit Played(const std::string &table, const std::string &toml = "", const char *name = "film.csv",
                      const bool names_sidecar = false)
      {
        const TemporaryFolder folder;
        if (!toml.empty())
          folder.write("film.toml", toml);
        folder.write(name, table);
        stream = recorded_lines(folder.path / (names_sidecar ? "film.toml" : name));
        for (const RecordedLine &line : stream.lines)
          if (!line.fault.empty())
            faults.push_back(line.fault);
          else if (const auto json = nlohmann::json::parse(line.text); json["type"] == "frame")
          {
            time_s.push_back(json["time_s"]);
            x_m.push_back(json["x_m"]);
            EXPECT_NE(line.where.find("film.csv:"), std::string::npos);
          }
      }

      void expect_faults(const std::vector<std::string> &wanted) const
      {
        ASSERT_EQ(faults.size(), wanted.size()) << fmt::format("{}", fmt::join(faults, "\n"));
        for (std::size_t i = 0; i < wanted.size(); ++i)
          expect_in(faults[i], wanted[i]);
      }
    };

    std::string refusal_of_table(const std::string &table, const std::string &toml = "", const char *name = "film.csv")
    {
      return message_of<InputError>([&] { Played(table, toml, name); });
    }

    const std::string log_header = "time_s,bx_T,by_T,x_m,y_m\n";

    std::string log_row(const double time_s)
    {
      return fmt::format("{},4e-3,1e-3,{},0\n", time_s, 1e-3 * time_s);
    }
  } // namespace

  TEST(RecordedLines, SayEachWrongRowOfALogWithItsLineAndGoOn)
  {
    const Played log(log_header + log_row(0.) + "0.1,4e-3,nan,0,0\n" + log_row(0.2) + "0.05,4e-3,1e-3,0,0\n" +
                     "0.3,4e-3,1e-3,here,0\n" + "0.4,4e-3\n" + log_row(0.5) + "0.6,4e-3,1e-3,0,0,1,2\n" +
                     "{\"type\":\"frame\"}\n" + "1e12,4e-3,1e-3,0,0\n" + log_row(0.7) + "0.8,4e-3,1e");
    EXPECT_EQ(log.time_s, (std::vector<double>{0., 0.2, 0.5, 0.7}));
    log.expect_faults(
        {"film.csv:3: by_T (column 3) = \"nan\" is not a finite number; correct it, or leave the row out.",
         "film.csv:5: time_s (column 1) = \"0.05\" does not come after 0.2 s; sort the rows by time",
         "film.csv:6: x_m (column 4) = \"here\" is not a finite number",
         "film.csv:7: this row has 2 values but the header names 5 columns; give one value per column",
         "film.csv:9: this row has 7 values", "film.csv:10: this row has 1 values",
         "film.csv:11: no clock says 1e+12 s; correct the time, or leave the row out.",
         "film.csv:13: this row has 3 values"});
    // About where they stand: the first behind the first frame and its field.
    EXPECT_FALSE(log.stream.lines[2].fault.empty());
    EXPECT_NE(log.stream.lines[3].where.find("film.csv:4"), std::string::npos);
  }

  TEST(RecordedLines, TakeALeapOfTheClockForOneWrongRow)
  {
    std::string table = log_header;
    for (int i = 0; i < 20; ++i)
      table += log_row(i == 5 ? 7e3 : 0.1 * i);
    const Played log(table);
    EXPECT_EQ(log.time_s.size(), 19u);
    log.expect_faults({"film.csv:7: time_s (column 1) = \"7000\" leaps ahead of those after it"});
  }

  TEST(RecordedLines, SayWrongRowsOfTracks)
  {
    std::string table = "frequency_Hz,time_s,x_m,y_m\n";
    for (int i = 0; i < 6; ++i)
      table += fmt::format("0.5,{},{},0\n", 0.1 * i, 1e-4 * i);
    table += "0.5,0.6,inf,0\nfast,0.7,0,0\n-0.5,0.7,0,0\n5.0,0.7,0,0\n0.5,0.3,0,0\n";
    for (int i = 0; i < 5; ++i)
      table += fmt::format("0.8,{},{},0\n", 0.1 * i, 1e-4 * i);
    const Played tracks(table + "0.8,0.5", sidecar);
    EXPECT_EQ(tracks.time_s.size(), 11u);
    tracks.expect_faults({"film.csv:8: x_m (column 3) = \"inf\" is not a finite number",
                          "film.csv:9: frequency_Hz (column 1) = \"fast\" is not a finite number",
                          "film.csv:10: frequency_Hz (column 1) = \"-0.5\" is not positive; give the frequency",
                          "film.csv:11: a row at 5 Hz, of which there are 1, is no track; at least 4 are needed",
                          "film.csv:12: time_s (column 2) = \"0.3\" does not come after 0.5 s",
                          "film.csv:18: this row has 2 values"});
  }

  TEST(RecordedLines, SayWrongRowsOfTrackmate)
  {
    std::string table = "TRACK_ID,POSITION_X,POSITION_Y,POSITION_T,FRAME\n";
    for (int i = 0; i < 6; ++i)
      table += fmt::format("1,{},10,{},{}\n", 100 - i, i, i);
    table += "one,1,2,6,6\nNone,1,2,6,6\n,1,2,6,6\n1.5,1,2,6,6\n1,x,2,6,6\n1,1,2,NaN,NaN\n1,4,5,3,3\n1,94,10,7,7\n1,9";
    const Played film(
        table,
        sidecar + "length_unit = \"pixel\"\npixel_m = 5e-6\nframe_s = 0.04\n[[recording]]\nfile = \"film.csv\"\n"
                  "frequency_Hz = 0.5\ntrack_id = 1\n",
        "film.csv", true);
    EXPECT_EQ(film.time_s.size(), 7u);
    film.expect_faults({"film.csv:8: TRACK_ID (column 1) = \"one\" is no number of a track; correct it",
                        "film.csv:11: TRACK_ID (column 1) = \"1.5\" is no number of a track",
                        "film.csv:12: POSITION_X (column 2) = \"x\" is not a finite number",
                        "film.csv:13: FRAME (column 5) = \"NaN\" is not a finite number",
                        "film.csv:14: FRAME (column 5) = \"3\" stands already on line 5",
                        "film.csv:16: this row has 2"});
  }

  TEST(RecordedLines, SayWrongRowsOfDeeplabcutAndWarnOfUnsureFrames)
  {
    std::string table = "scorer,n,n,n\nbodyparts,head,head,head\ncoords,x,y,likelihood\n";
    for (int i = 0; i < 6; ++i)
      table += fmt::format("{},{},10,0.9\n", i, 100 - i);
    const Played film(
        table + "6,1,2,sure\n7,1,2,7\n8,1,2,0.1\n9,,,\n10,1,2,nan\n2,1,2,0.9\n11,here,2,0.9\n12,90,1,0.9\n13,1",
        sidecar + "pixel_m = 5e-6\nframe_s = 0.04\n[[recording]]\nfile = \"film.csv\"\n"
                  "frequency_Hz = 0.5\nbody_part = \"head\"\n",
        "film.csv", true);
    EXPECT_EQ(film.time_s.size(), 7u);
    film.expect_faults({"film.csv:10: n (column 4) = \"sure\" is not a finite number",
                        "film.csv:11: n (column 4) = \"7\" is no likelihood; it lies between 0 and 1",
                        "film.csv:14: n (column 4) = \"nan\" is not a finite number",
                        "film.csv:15: scorer (column 1) = \"2\" does not come after",
                        "film.csv:16: n (column 2) = \"here\" is not a finite number", "film.csv:18: this row has 2"});
    ASSERT_EQ(film.stream.warnings.size(), 1u);
    expect_in(film.stream.warnings.front(), "2 of 9 frames are left out because their likelihood is below 0.6");
  }

  TEST(RecordedLines, RefuseWhatIsWrongAsAWhole)
  {
    expect_in(refusal_of_table(""), "the file is empty");
    expect_in(refusal_of_table("", "", "film.jsonl"), "the file is empty");
    expect_in(refusal_of_table(log_header), "film.csv:1: there are no rows; a log needs a row per frame.");
    expect_in(refusal_of_table(std::string("\x89PNG\r\n\x1a\n\0\0\0\r", 12)), "film.csv");
    // Nothing is left: then it is said why.
    const std::string nothing = refusal_of_table(log_header + "nan,4e-3,1e-3,0,0\n0,4e-3,1e-3\n");
    expect_in(nothing, "film.csv:2: time_s (column 1) = \"nan\" is not a finite number");
    expect_in(nothing, "film.csv:3: this row has 3 values");
    expect_in(nothing, "there are no rows");
    expect_in(refusal_of_table("time_s,x_m,y_m\n0,0,0\n"), "the recording has no field");
  }

  TEST(RecordedLines, ThrowLongLinesAwayAndCutLongCellsInSentences)
  {
    const Played lines("{\"type\":\"end\"}\n" + std::string(LineReader::most_bytes + 1, '[') + "\n{\"type\":\"end\"}",
                       "", "film.jsonl");
    EXPECT_EQ(lines.stream.lines.size(), 3u);
    lines.expect_faults({"the line is longer than 65536 bytes"});
    const Played log(log_header + log_row(0.) + "0.1,4e-3,1e-3," + std::string(100000, 'x') + ",0\n");
    log.expect_faults({"film.csv:3: x_m (column 4) = \"xxxxx"});
    EXPECT_LT(log.faults.front().size(), 200u + std::string("film.csv").size() + 100u);
  }
} // namespace swimtwin
