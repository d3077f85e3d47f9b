#include <reports/page/gnuplot.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/reports/synthetic_calibration.h>

namespace swimtwin
{
  namespace
  {
    Outcome report_tool(std::vector<std::string> arguments)
    {
      arguments.insert(arguments.begin(), "report");
      return run_in_process(arguments, {{"report", add_report}});
    }
  } // namespace

  TEST(ReportVerb, MakesThePageOfAFit)
  {
    const TemporaryFolder folder;
    write_calibration_result(folder.path / "calibration.json", synthetic_calibration());
    ASSERT_EQ(report_tool({folder.path, "--quiet"}).code, 0);
    const std::string page = content(folder.path / "report.html");
    expect_in(page, "class=\"verdict good\">converged");
    if (!find_gnuplot_fault())
      expect_in(page, "<img alt=\"next experiment\"");
    EXPECT_EQ(n_files(folder.path), 2u); // what was drawn on is gone
    folder.write("calibration.json", "{}");
    EXPECT_EQ(report_tool({folder.path, "--quiet", "--force"}).code, 2);
    EXPECT_EQ(content(folder.path / "report.html"), page);
  }
} // namespace swimtwin
