#include <app/frame/written_files.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/field_program.h>
#include <datasets/system/provenance.h>
#include <datasets/text/csv_table.h>
#include <tests/app/declared_files.h>
#include <tests/app/tool_in_process.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>

namespace swimtwin
{
  namespace
  {
    Outcome track_tool(const std::vector<std::string> &arguments)
    {
      return run_in_process(arguments, {{"track", add_track}});
    }

    /// On the shipped swimmer without walls, for a few periods, without inertia.
    class TrackVerb : public ::testing::Test
    {
    protected:
      Outcome track(const std::string &goal, const std::vector<std::string> &options = {}) const
      {
        std::ofstream(folder.path / "goal.toml") << goal;
        std::vector<std::string> arguments = {"track",
                                              std::string(places::models) + "/open-2d.h5",
                                              folder.path / "goal.toml",
                                              "--output",
                                              results,
                                              "--no-picture",
                                              "--inertia",
                                              "none"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return track_tool(arguments);
      }

      const TemporaryFolder folder;
      const std::string     results = folder.path / "results";
      const std::string     line    = "kind = \"path\"\n[path]\nshape = \"line\"\nsize_m = 6e-4\n"
                                      "[loop]\ndecisions_per_second = 5.0\nsample_rate_Hz = 50.0\n";
    };
  } // namespace

  TEST_F(TrackVerb, WritesTableFieldAndSummary)
  {
    const Outcome outcome = track(line);
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_NE(outcome.output.find("plan               arrived"), std::string::npos) << outcome.output;
    const CsvTable table = CsvTable::read(folder.path / "results/track.csv");
    EXPECT_EQ(table.column_names()[0], "time_s");
    EXPECT_GT(table.n_rows(), 10u);
    EXPECT_GE(table.column("arc_m").back(), 4e-4);
    const auto json = nlohmann::json::parse(content(folder.path / "results/track.json"));
    EXPECT_EQ(json["status"], "arrived");
    EXPECT_EQ(json["replay"], "not confirmed");
    EXPECT_LE(json["rms_distance_body_lengths"].get<double>(), 0.03);
    EXPECT_LE(json["largest_field_T"].get<double>(), 7.0711e-3);
    EXPECT_FALSE(json["provenance"]["scene_hash"].get<std::string>().empty());
    expect_all_declared(results, written_by::optimize().patterns);
  }

  TEST_F(TrackVerb, FieldIsAProgramThatCanBePlayed)
  {
    ASSERT_EQ(track(line, {"--quiet"}).code, 0);
    const CsvTable     table = CsvTable::read(folder.path / "results/field.csv");
    const FieldProgram field = FieldProgram::read_csv(folder.path / "results/field.csv");
    EXPECT_NEAR(field.period_s(), table.column("time_s").back() + 0.02, 1e-9);
    EXPECT_EQ(field.b_T().size(), table.n_rows());
  }

  TEST_F(TrackVerb, SwimsToATarget)
  {
    const Outcome outcome = track("kind = \"target\"\n[target]\nposition_m = [8e-4, 1e-4]\ndistance = 0.02\n"
                                  "sample_rate_Hz = 100.0\n");
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_NE(outcome.output.find("arrived after"), std::string::npos) << outcome.output;
    const CsvTable table = CsvTable::read(folder.path / "results/track.csv");
    EXPECT_LE(table.column("distance_m").back(), 0.0201 * 7.75e-3);
    const auto json = nlohmann::json::parse(content(folder.path / "results/track.json"));
    EXPECT_EQ(json["kind"], "target");
    EXPECT_EQ(json["status"], "arrived");
    EXPECT_NEAR(json["duration_s"].get<double>(), table.column("time_s").back(), 1e-9);
    EXPECT_NEAR(json["end_distance_body_lengths"].get<double>(), table.column("distance_m").back() / 7.75e-3, 1e-4);
    const CsvTable field = CsvTable::read(folder.path / "results/field.csv");
    EXPECT_NEAR(field.column("time_s").back(), json["duration_s"].get<double>(), 0.0101);
  }

  TEST_F(TrackVerb, SaysWhichTargetIsInfeasible)
  {
    // Above what a settled swim needs straight on, below what the start from rest and the turn leave.
    const std::string target = "kind = \"target\"\n[target]\nposition_m = [-6e-4, 0.0]\n";
    const Outcome     late   = track(target + "time_limit_s = 3.0\n");
    EXPECT_EQ(late.code, 2);
    EXPECT_NE(late.errors.find("infeasible"), std::string::npos) << late.errors;
    EXPECT_EQ(nlohmann::json::parse(content(folder.path / "results/track.json"))["status"], "infeasible");
    EXPECT_FALSE(std::filesystem::exists(folder.path / "results/field.csv"));
    const Outcome far = track(target + "time_limit_s = 0.5\n", {"--force"});
    EXPECT_EQ(far.code, 2);
    EXPECT_NE(far.errors.find("time_limit_s = 0.5 is too short"), std::string::npos) << far.errors;
  }

  TEST_F(TrackVerb, CarriesInertiaWhereTheModelHasIt)
  {
    std::ofstream(folder.path / "goal.toml") << line;
    const std::string goal = folder.path / "goal.toml";
    const auto        swum = [&](const std::string &model, const std::string &inertia) {
      return track_tool({"track", model, goal, "--output", results + inertia, "--no-picture", "--inertia", inertia});
    };
    const std::string shipped     = std::string(places::models) + "/reference-2d.h5",
                      without_any = folder.path / "without.h5";
    ReducedModel stripped         = read_reduced_model(shipped);
    stripped.inertia              = {};
    write_reduced_model(without_any, stripped, Provenance{});
    EXPECT_EQ(swum(without_any, "full").code, 2);
    std::map<std::string, nlohmann::json> records;
    for (const std::string inertia : {"none", "full"})
    {
      const Outcome outcome = swum(shipped, inertia);
      ASSERT_EQ(outcome.code, 0) << outcome.errors;
      records[inertia] = nlohmann::json::parse(std::ifstream(results + inertia + "/track.json"));
      EXPECT_EQ(records[inertia]["status"], "arrived");
    }
    EXPECT_EQ(records["none"]["inertia"].size(), 0u);
    EXPECT_EQ(records["full"]["inertia"].size(), 4u);
    const double with = records["full"]["advance_per_period_m"], without = records["none"]["advance_per_period_m"];
    EXPECT_GT(std::abs(with / without - 1.), 2e-3);
    EXPECT_LT(std::abs(with / without - 1.), 0.2);
  }

  TEST_F(TrackVerb, RefusesBadGoalsAndAMissingPlant)
  {
    const Outcome tight = track("kind = \"path\"\n[path]\nshape = \"circle\"\nsize_m = 1e-3\n");
    EXPECT_EQ(tight.code, 2);
    EXPECT_NE(tight.errors.find("than the swimmer can follow"), std::string::npos) << tight.errors;
    const Outcome plant = track("kind = \"closed-loop\"\n[path]\nshape = \"line\"\nsize_m = 1e-3\n"
                                "[loop]\nplant = \"full-order\"\n");
    EXPECT_EQ(plant.code, 2);
    EXPECT_NE(plant.errors.find("release build"), std::string::npos) << plant.errors;
    EXPECT_FALSE(std::filesystem::exists(folder.path / "results/track.json"));
  }
} // namespace swimtwin
