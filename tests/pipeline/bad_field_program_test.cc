#include <tests/pipeline/simulation.h>
#include <tests/places.h>

namespace swimtwin
{
  namespace
  {
    /// A scene whose field program has this text: exit code 2, one sentence with these parts, nothing written.
    void expect_refused_program(const std::string &csv, const std::vector<std::string> &parts)
    {
      const TemporaryFolder folder;
      folder.write("field.csv", csv);
      std::string text  = content(std::string(places::scenes) + "/reference-2d-casefile.toml");
      const auto  field = text.find("[field]"), next = text.find("[time]");
      text.replace(field, next - field, "[field]\nprogram = \"field.csv\"\nperiod_s = 1.0\n");
      const auto scene = folder.write("scene.toml", text);
      expect_failure(run_tool({"simulate", scene, "--output", folder.path / "run"}), 2, parts);
      EXPECT_FALSE(std::filesystem::exists(folder.path / "run"));
    }
  } // namespace

  TEST(BadFieldProgram, AGapIsNamedWithItsLine)
  {
    expect_refused_program("time_s,bx_T,by_T\n0,0,0\n0.1,0,0\n0.2,0,0\n0.3,0,0\n0.8,0,0\n0.9,0,0\n",
                           {"field.csv:6", "gap"});
  }

  TEST(BadFieldProgram, AGapBeforeTheNextPeriodIsOneToo)
  {
    expect_refused_program("time_s,bx_T,by_T\n0,0,0\n0.1,0,0\n0.2,0,0\n0.3,0,0\n",
                           {"field.csv:5", "gap", "next period"});
  }

  TEST(BadFieldProgram, TimesThatDoNotIncreaseAreNamedWithTheirLine)
  {
    expect_refused_program("time_s,bx_T,by_T\n0,0,0\n0.25,0,0\n0.2,0,0\n0.75,0,0\n",
                           {"field.csv:4", "does not increase"});
  }

  TEST(BadFieldProgram, AValueThatIsNoNumberIsNamedWithItsLine)
  {
    expect_refused_program("time_s,bx_T,by_T\n0,0,0\n0.25,0,0\n0.5,high,0\n0.75,0,0\n", {"field.csv:4", "high"});
  }

  TEST(BadFieldProgram, AMissingColumnIsNamed)
  {
    expect_refused_program("time_s,bx_T\n0,0\n0.25,0\n0.5,0\n0.75,0\n", {"field.csv", "by_T"});
  }

  TEST(BadFieldProgram, AMissingFileIsNamed)
  {
    const TemporaryFolder folder;
    expect_failure(run_tool({"simulate", std::string(places::scenes) + "/reference-2d-casefile.toml", "--output",
                             folder.path / "run", "--set", "field={program=\"nowhere.csv\", period_s=1.0}"}),
                   2, {"nowhere.csv", "No such file"});
  }
} // namespace swimtwin
