// Tables of other programs, read by the tool as a user would.
#include <datasets/observation/observation_set.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>
#include <tests/replaced.h>

namespace swimtwin
{
  namespace
  {
    std::filesystem::path case_file(const std::string &name)
    {
      return std::filesystem::path(places::source) / "tests/datasets/cases" / name;
    }

    Outcome check_data(const std::vector<std::string> &files)
    {
      std::vector<std::string> arguments{"calibrate", "reference-2d", case_file("curves/problem.toml"), "--check",
                                         "--data"};
      arguments.insert(arguments.end(), files.begin(), files.end());
      return run_in_process(arguments, {{"calibrate", add_calibrate}});
    }

    void expect_read(const std::string &name, const std::string &part, const std::string &other = "")
    {
      const Outcome outcome = check_data({case_file(name)});
      EXPECT_EQ(outcome.code, 0) << outcome.errors;
      expect_in(outcome.output, part);
      expect_in(outcome.output, other);
    }
  } // namespace

  TEST(CalibrateCheck, ReadsWhatASpreadsheetSaves)
  {
    for (const char *name : {"excel/semicolon-comma.csv", "excel/empty-columns.csv", "excel/empty-rows.csv"})
      expect_read(name, "12 observations at 0.2 to 2.6 Hz", "displacement   0.0686 to 0.184 mm per period");
  }

  TEST(CalibrateCheck, ReadsTheFileThatWasNamed)
  {
    expect_read("same-name/run.txt", "displacement   0.0686 to 0.184 mm per period");
    expect_read("same-name/run.csv", "displacement   0.0343 to 0.092 mm per period");
    const Outcome both = check_data({case_file("same-name/run.toml")});
    EXPECT_EQ(both.code, 2);
    expect_in(both.errors, "run.csv, run.txt lie beside this sidecar");
  }

  TEST(CalibrateCheck, NeverGuessesAUnit)
  {
    const Outcome unknown = check_data({case_file("trackmate/one-header-row.toml")});
    EXPECT_EQ(unknown.code, 2);
    expect_in(unknown.errors, "[camera] length_unit = \"um\"");
    const TemporaryFolder folder;
    for (const char *name : {"a.csv", "b.csv"})
      std::filesystem::copy(case_file("trackmate") / name, folder.path / name);
    const std::string sidecar = content(case_file("trackmate/one-header-row.toml"));
    const Outcome     said =
        check_data({folder.write("said.toml", replaced(sidecar, "pixel_m = 5e-6", "length_unit = \"um\""))});
    EXPECT_EQ(said.code, 0) << said.errors;
    expect_in(said.output, "displacement   0.17 mm per period");
    expect_read("trackmate/windows-micron.toml", "displacement   0.17 mm per period");
    expect_read("curves/mm.csv", "displacement   0.0686 to 0.184 mm per period");
  }

  TEST(CalibrateCheck, TakesReplicatesAndOutliersAsData)
  {
    expect_read("curves/replicates.csv", "36 observations");
    expect_read("curves/outlier.csv", "12 observations", "displacement   0.0686 to 1.84 mm per period");
  }

  TEST(CalibrateCheck, TakesSeveralFilesInAnyOrderOfArguments)
  {
    const std::string a = case_file("same-name/run.txt"), b = case_file("same-name/run.csv"),
                      c                                 = case_file("curves/mm.csv");
    const std::string                           problem = case_file("curves/problem.toml");
    const std::vector<std::vector<std::string>> orders{
        {"reference-2d", problem, "--data", a, b, c, "--check"},
        {"reference-2d", problem, "--data", a, "--data", b, "--data", c, "--check"},
        {"--data", a, b, c, "reference-2d", problem, "--check"},
        {"reference-2d", "--data", a, b, c, problem, "--check"},
        {"--check", "--data", a, b, "--data", c, "reference-2d", problem}};
    for (std::vector<std::string> order : orders)
    {
      order.insert(order.begin(), "calibrate");
      const Outcome outcome = run_in_process(order, {{"calibrate", add_calibrate}});
      EXPECT_EQ(outcome.code, 0) << outcome.errors;
      for (const char *set : {"\n  run.txt\n", "\n  run.csv\n", "\n  mm\n"})
        expect_in(outcome.output, set);
    }
    const Outcome alone = run_in_process({"calibrate", "--data", a, "--check"}, {{"calibrate", add_calibrate}});
    EXPECT_EQ(alone.code, 2);
    expect_in(alone.errors, "the model is required");
  }

  TEST(CalibrateCheck, NamesLineAndValuesOfAnUnknownMethod)
  {
    const TemporaryFolder folder;
    const auto            problem = folder.write(
                   "fit.toml", replaced(content(case_file("curves/problem.toml")), "starts = 4", "method = \"gauss-newton\""));
    const Outcome outcome =
        run_in_process({"calibrate", "reference-2d", problem, "--data", case_file("curves/mm.csv"), "--check"},
                       {{"calibrate", add_calibrate}});
    EXPECT_EQ(outcome.code, 2);
    expect_in(outcome.errors, "fit.toml:11: [fit] method = \"gauss-newton\" is not known; the nearest is ");
    expect_in(outcome.errors, "(one of \"lbfgs\", \"mma\", ");
  }

  TEST(ShippedFiles, AreNotMistakenForAFileOfTheUser)
  {
    const TemporaryFolder       folder;
    const std::filesystem::path before = std::filesystem::current_path();
    folder.write("reference-2d.h5", "another model");
    std::filesystem::current_path(folder.path);
    const Outcome either = check_data({case_file("curves/mm.csv")});
    std::filesystem::current_path(before);
    EXPECT_EQ(either.code, 2);
    expect_in(either.errors, "reference-2d is shipped, and reference-2d.h5 lies here too; say which is meant");
  }
} // namespace swimtwin
