#include <reports/sweep/sweep_files.h>

#include <datasets/text/csv_table.h>
#include <reports/sweep/sweep_report.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/reports/tag_balance.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    SweepResult result_at(const double frequency_Hz, const double displacement_m, const std::string &note)
    {
      SweepResult result;
      result.member                  = {{8e4, 1.52, 1e5, 0.}, 5e-3, 5e-3, frequency_Hz};
      result.displacement_m          = displacement_m;
      result.periodic_displacement_m = result.error_indicator_m = displacement_m;
      result.note                                               = note;
      return result;
    }

    /// Two members, of which the first may fail.
    class SweepFiles : public ::testing::Test
    {
    protected:
      void write(const double first_displacement_m, const std::string &note)
      {
        const std::vector<SweepResult> results = {result_at(0.3, first_displacement_m, note),
                                                  result_at(0.8, 0.1 + 0.2, "")};
        SweepRecord                    record;
        record.model_file                 = "model.h5";
        record.n_modes                    = 4;
        record.provenance.program_version = "swimtwin 0";
        record.provenance.command_line    = "swimtwin sweep <model>";
        write_sweep_table(folder.path / sweep_table_name, results);
        write_sweep_summary(folder.path / sweep_summary_name, {}, results, record);
      }
      std::string page() const { return sweep_page(read_sweep(folder.path), {}, folder.path).text(); }

      const TemporaryFolder folder;
    };
  } // namespace

  TEST_F(SweepFiles, AMemberThatWasNotComputedIsARowWithoutADisplacementThatSaysWhy)
  {
    write(std::nan(""), "it broke, at \"0.2\" s\nsays CVODES");
    const CsvTable table = CsvTable::read(folder.path / sweep_table_name);
    ASSERT_EQ(table.n_rows(), 2u);
    EXPECT_EQ(content(folder.path / sweep_table_name),
              "young_modulus_Pa,frequency_Hz,displacement_m,viscosity_Pa_s,magnetization_A_m,bx_T,by_T,"
              "periodic_displacement_m,error_indicator_m,inside_trained_range,held_out_error,error_95_m,status,note\n"
              "80000,0.3,,1.52,100000,0.005,0.005,,,1,0,0,failed,\"it broke, at \"\"0.2\"\" s says CVODES\"\n"
              "80000,0.8,0.30000000000000004,1.52,100000,0.005,0.005,0.30000000000000004,0.30000000000000004,1,0,0,"
              "completed,ok\n");
    const auto json = nlohmann::json::parse(content(folder.path / sweep_summary_name));
    ASSERT_EQ(json["not_computed"].size(), 1u);
    EXPECT_EQ(json["not_computed"][0]["frequency_Hz"], 0.3);
    EXPECT_EQ(json["not_computed"][0]["note"], "it broke, at \"0.2\" s\nsays CVODES");
  }

  TEST_F(SweepFiles, ThePageCountsRowsThatWereNotComputedAndLeavesThemOutOfTheCurves)
  {
    write(std::nan(""), "it broke");
    EXPECT_EQ(read_sweep(folder.path).curves.at(0).points.size(), 1u);
    expect_in(page(), "class=\"verdict bad\">1 of 2 rows were not computed");
    write(1e-4, "");
    expect_in(page(), "class=\"verdict good\">2 rows, 1 curves");
  }

  TEST_F(SweepFiles, ThePageSaysWhereTheTableComesFrom)
  {
    write(1e-4, "");
    const std::string text = page();
    EXPECT_EQ(first_unbalanced_tag(text), "");
    expect_in(text, "swimtwin sweep &lt;model&gt;");
    expect_in(text, "model.h5, 4 modes");
    folder.write("sweep.json", "{}");
    expect_in(message_of<InputError>([&] { read_sweep(folder.path); }), "sweep.json lacks the entry provenance");
    folder.write("sweep.json", "cut sho");
    expect_in(message_of<InputError>([&] { read_sweep(folder.path); }), "sweep.json lacks the entry provenance");
  }
} // namespace swimtwin
