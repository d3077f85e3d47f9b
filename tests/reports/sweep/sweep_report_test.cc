#include <reports/sweep/sweep_report.h>

#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/reports/synthetic_run.h>
#include <tests/reports/tag_balance.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string table_text = "# made up\n"
                                   "young_modulus_Pa,frequency_Hz,displacement_m,remark\n"
                                   "1e5,1.6,1.0e-4,a<b\n"
                                   "1e5,0.8,1.7e-4,\n"
                                   "1e5,0.4,-0.2e-4,backwards\n";

    class SweepReport : public ::testing::Test
    {
    protected:
      std::string page() const
      {
        const std::string text = sweep_page(read_sweep(folder.path), {}, folder.path).text();
        EXPECT_EQ(first_unbalanced_tag(text), "");
        return text;
      }

      void write_run(const std::string &name, const double frequency_Hz, const double displacement_m,
                     const std::string &status = "completed") const
      {
        const Scene scene = synthetic_scene({fmt::format("field.frequency_Hz={}", frequency_Hz)});
        RunRecord   record;
        record.summary.status     = status;
        record.summary.cpu_time_s = 12.5;
        if (status == "completed")
          record.summary.displacement_per_period_m = {displacement_m};
        record.summary.net_displacement_m = displacement_m;
        record.summary.power_imbalance    = 2e-4;
        record.provenance.scene_text      = scene.text;
        fs::create_directory(folder.path / name);
        write_run_summary_json(folder.path / name / "summary.json", record);
      }

      const TemporaryFolder folder;
    };
  } // namespace

  TEST_F(SweepReport, TableHasItsPeakAndKeepsAllColumns)
  {
    folder.write("displacement_frequency.csv", table_text);
    const std::string text = page();
    const auto        peak = cells_of(text, "E = 100000 Pa");
    ASSERT_EQ(peak.size(), 4u);
    EXPECT_EQ(peak[0], "3");
    EXPECT_NEAR(number_in(peak[1]), 0.17, 1e-12);
    EXPECT_EQ(peak[2], "0.8");
    EXPECT_EQ(peak[3], "");
    expect_in(text, "<th scope=\"col\">remark</th>");
    expect_in(text, "a&lt;b");
    expect_in(text, "backwards");
    expect_in(text, "# made up");
  }

  TEST_F(SweepReport, PeakAtTheEndOfACurveIsToldSo)
  {
    folder.write("displacement_frequency.csv",
                 "young_modulus_Pa,frequency_Hz,displacement_m\n1e5,1,1e-4\n1e5,2,2e-4\n");
    EXPECT_EQ(cells_of(page(), "E = 100000 Pa").at(3), "at the end of the curve");
  }

  TEST_F(SweepReport, RunsAreListedWithTheirNumbersAndLinkedToTheirPages)
  {
    write_run("f=0.8", 0.8, 1.7e-4);
    write_run("f=1.6", 1.6, 1.0e-4);
    write_run("f=3.2", 3.2, 0., "failed: no");
    folder.write("f=0.8/report.html", "");
    const std::string text = page();
    expect_in(text, "class=\"verdict bad\">2 of 3 runs completed");
    const auto linked = cells_of(text, "<a href=\"f%3D0.8/report.html\">f=0.8</a>");
    ASSERT_EQ(linked.size(), 6u);
    EXPECT_EQ(linked[0], "completed");
    EXPECT_EQ(linked[1], "0.8");
    EXPECT_EQ(linked[2], "100000");
    EXPECT_NEAR(number_in(linked[3]), 0.17, 1e-12);
    EXPECT_NEAR(number_in(linked[4]), 0.02, 1e-12);
    EXPECT_EQ(linked[5], "12.5");
    EXPECT_EQ(cells_of(text, "f=3.2"), (std::vector<std::string>{"failed: no", "3.2", "100000", "–", "–", "12.5"}));
    EXPECT_EQ(cells_of(text, "E = 100000 Pa").at(0), "2"); // the failed run is no point of the curve
  }

  TEST_F(SweepReport, LinksAreSeenFromThePage)
  {
    write_run("soft", 0.8, 1.7e-4);
    folder.write("soft/report.html", "");
    fs::create_directory(folder.path / "page");
    expect_in(sweep_page(read_sweep(folder.path), {}, folder.path / "page").text(), "href=\"../soft/report.html\"");
  }

  TEST_F(SweepReport, RunsAtOneFrequencyMakeNoCurve)
  {
    write_run("a", 0.8, 1.7e-4);
    write_run("b", 0.8, 1.8e-4);
    EXPECT_TRUE(read_sweep(folder.path).curves.empty());
    expect_in(page(), "class=\"verdict good\">2 of 2 runs completed");
  }

  TEST_F(SweepReport, RunsThatDifferInSomethingElseAreWarnedOf)
  {
    write_run("a", 0.8, 1.7e-4);
    write_run("b", 0.8, 1.8e-4);
    write_run("c", 1.6, 1.8e-4);
    expect_in(page(), "several points at one frequency");
  }

  TEST_F(SweepReport, TableAndRunsStandOnOnePage)
  {
    folder.write("displacement_frequency.csv", table_text);
    write_run("a", 0.8, 1.7e-4);
    const std::string text = page();
    EXPECT_EQ(cells_of(text, "E = 100000 Pa").at(0), "3");
    EXPECT_EQ(cells_of(text, "a").at(0), "completed");
  }

  TEST_F(SweepReport, BadInputIsNamedWithItsRemedy)
  {
    const auto message = [&] { return message_of<InputError>([&] { read_sweep(folder.path); }); };
    expect_in(message(), folder.path.string() + " holds no results");
    folder.write("checkpoint.h5", "");
    expect_in(message(), "--resume");
    const std::string file = (folder.path / "displacement_frequency.csv").string();
    folder.write("displacement_frequency.csv", "young_modulus_Pa,frequency_Hz,displacement_m\n");
    expect_in(message(), file + " has a header and no rows");
    folder.write("displacement_frequency.csv", "young_modulus_Pa,frequency_Hz\n1e5,1\n");
    expect_in(message(), file + ":1: the column displacement_m is missing");
    folder.write("displacement_frequency.csv", "young_modulus_Pa,frequency_Hz,displacement_m\n1e5,1,far\n");
    expect_in(message(), file + ":2: displacement_m = \"far\"");
    fs::create_directory(folder.path / "run");
    folder.write("run/summary.json", "{}");
    expect_in(message(), (folder.path / "run/summary.json").string());
  }
} // namespace swimtwin
