#include <reports/twin/twin_pictures.h>
#include <reports/twin/twin_report.h>

#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace swimtwin
{
  namespace
  {
    const char *header =
        "time_s,x_m,y_m,angle_rad,x_sd_m,y_sd_m,angle_sd_rad,shape_1_m,young_modulus_over_viscosity_1_s,"
        "sd_of_young_modulus_over_viscosity_1_s,innovation_x_m,innovation_y_m,innovation_sd_m,"
        "innovation_angle_rad,innovation_angle_sd_rad,significance,trust,flags,line\n";

    /// A twin's table of n rows, the stiffness falling from 5e4 to 4e4.
    void write_table(const std::filesystem::path &folder, const int n)
    {
      std::ofstream out(folder / "twin.csv");
      out << header;
      for (int i = 0; i < n; ++i)
        out << fmt::format("{},{},0,0,1e-5,1e-5,1e-2,0,{},{},1e-5,-1e-5,2e-5,,,0.5,1,{},{}\n", 0.1 * i, 1e-4 * i,
                           5e4 - 1e4 * i / std::max(1, n - 1), 100., i == 3 ? "frozen;near-wall" : "", i + 1);
    }

    void write(const std::filesystem::path &file, const std::string &text)
    {
      std::ofstream(file) << text;
    }

    const char *alarms =
        R"({"type":"alarm","version":1,"time_s":2,"name":"sight-lost","since_s":1.5,"over":false,"what":"w","remedy":"r"}
{"type":"alarm","version":1,"time_s":3,"name":"sight-lost","since_s":1.5,"over":true}
{"type":"alarm","version":1,"time_s":4,"name":"jump: stiffness","since_s":3.9,"over":false,"what":"changed","remedy":"look"}
)";

    std::string refusal(const std::filesystem::path &folder)
    {
      try
      {
        read_twin_record(folder);
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "";
    }
  } // namespace

  TEST(TwinRecord, HoldsFirstAndLastRowOfALongTable)
  {
    const TemporaryFolder folder;
    write_table(folder.path, 10001);
    const TwinRecord record = read_twin_record(folder.path);
    EXPECT_EQ(record.n_rows, 10001);
    EXPECT_LE(record.time_s().size(), 3002U);
    EXPECT_EQ(record.time_s().front(), 0.);
    EXPECT_NEAR(record.time_s().back(), 1000., 1e-9);
    EXPECT_NEAR(record.columns.at("young_modulus_over_viscosity_1_s").back(), 4e4, 1e-6);
    EXPECT_TRUE(std::isnan(record.columns.at("innovation_angle_rad").front()));
    ASSERT_EQ(record.parameters.size(), 1U);
    EXPECT_EQ(record.parameters.front().symbol, "E/μ");
  }

  TEST(TwinRecord, HoldsWhatWasProposedAndThePageShowsIt)
  {
    const TemporaryFolder folder;
    write_table(folder.path, 10);
    const std::string
        start =
            R"({"type":"proposal","version":1,"time_s":6,"parameter":"young_modulus_over_viscosity_log","sd":0.02,"ahead_s":2.5,)"
            R"("as_is":{"frequency_Hz":0.8,"largest_T":5e-3,"sd":0.015,"speed_m_s":1e-4},"proposed":)",
        field = R"({"frequency_Hz":1.2,"largest_T":7e-3,"sd":0.011,"speed_m_s":1.2e-4,"bx_times":1,"by_times":1.5})";
    write(folder.path / "twin-proposals.jsonl", start + field + "}\n" + start + "null}\n");
    const TwinRecord record = read_twin_record(folder.path);
    ASSERT_EQ(record.proposals.size(), 2U);
    ASSERT_TRUE(record.proposals[0].proposed.has_value());
    EXPECT_EQ(record.proposals[0].proposed->sd, 0.011);
    EXPECT_FALSE(record.proposals[1].proposed.has_value());
    const std::string page = twin_page(record, {}).text();
    for (const char *part : {"Fields that would tell more", "0.011", "nothing better", "120, 100"})
      EXPECT_NE(page.find(part), std::string::npos) << part;
    write(folder.path / "twin-proposals.jsonl", "{}\n");
    EXPECT_NE(refusal(folder.path).find("twin-proposals.jsonl:1: has an entry of the wrong kind"), std::string::npos);
  }

  TEST(TwinRecord, EndsAnAlarmWithItsOwnEnd)
  {
    const TemporaryFolder folder;
    write_table(folder.path, 10);
    write(folder.path / "twin-alarms.jsonl", alarms);
    const TwinRecord record = read_twin_record(folder.path);
    ASSERT_EQ(record.alarms.size(), 2U);
    EXPECT_EQ(record.alarms[0].until_s, 3.);
    EXPECT_FALSE(record.alarms[1].until_s.has_value());
    EXPECT_EQ(record.alarms[1].name, "jump: stiffness");
  }

  TEST(TwinRecord, SaysWhatItsFilesLack)
  {
    const TemporaryFolder folder;
    write_table(folder.path, 3);
    std::ofstream(folder.path / "twin.csv", std::ios::app) << "0.4,1\n";
    EXPECT_NE(refusal(folder.path).find("twin.csv:5: has 2 cells"), std::string::npos) << refusal(folder.path);
    write(folder.path / "twin.csv", std::string("time_s,x_m\n0,one\n"));
    EXPECT_NE(refusal(folder.path).find("twin.csv:2: x_m = \"one\" is no number"), std::string::npos);
    write(folder.path / "twin.csv", "x_m,y_m\n0,1\n");
    EXPECT_NE(refusal(folder.path).find("lacks the column time_s"), std::string::npos);
    write_table(folder.path, 3);
    write(folder.path / "twin-alarms.jsonl", "nonsense\n");
    EXPECT_NE(refusal(folder.path).find("twin-alarms.jsonl:1: is no alarm"), std::string::npos);
    write(folder.path / "twin-alarms.jsonl", "");
    write(folder.path / "twin.json", "{\"status\": 3}");
    EXPECT_NE(refusal(folder.path).find("twin.json is not as"), std::string::npos) << refusal(folder.path);
  }

  TEST(TwinPage, ShowsParametersAlarmsAndThatItWasInterrupted)
  {
    const TemporaryFolder folder;
    write_table(folder.path, 20);
    write(folder.path / "twin-alarms.jsonl", alarms);
    const TwinRecord  record = read_twin_record(folder.path);
    const std::string page   = twin_page(record, {}).text();
    for (const char *shown : {"interrupted", "20 estimates", "2 alarms", "E/μ", "50", "40", "jump: stiffness", "look"})
      EXPECT_NE(page.find(shown), std::string::npos) << shown;
    std::vector<std::string> names;
    for (const GnuplotPicture &picture : twin_pictures(record))
      names.push_back(picture.name);
    EXPECT_EQ(names, (std::vector<std::string>{"parameters", "innovations", "swim"}));
  }

  TEST(TwinPage, SaysThatNothingWasSeen)
  {
    const TemporaryFolder folder;
    write_table(folder.path, 0);
    EXPECT_NE(twin_page(read_twin_record(folder.path), {}).text().find("nothing was seen"), std::string::npos);
  }
} // namespace swimtwin
