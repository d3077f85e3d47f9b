#include <datasets/files/json_entries.h>
#include <datasets/run/plan_result.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    PlannedField field(const std::string &name, const double speed)
    {
      PlannedField field;
      field.name           = name;
      field.status         = "converged";
      field.bx_T           = {1e-3, 2e-3, 3e-3};
      field.by_T           = {0., 0., 5e-3};
      field.start          = {0.1, 1e-4};
      field.moves          = true;
      field.mean_speed_m_s = speed;
      field.multipliers    = {0.5, 0.1};
      field.terms          = {{"mean_speed", speed}};
      field.trace          = {{10, -1., 0.5, 3}, {30, -2., 0., 8}};
      return field;
    }
  } // namespace

  TEST(PlanResult, ComesBackAsItWasWritten)
  {
    const TemporaryFolder folder;
    PlanResult            written;
    written.status     = "converged";
    written.fields     = {field(tuned_field_name, 4e-4), field(optimal_field_name, 6e-4)};
    written.trade_off  = {{0.5, 1e-4, 2e-4, 1., 2., "converged", "stalled"}};
    written.warnings   = {"a doubt"};
    written.refinement = {{"model.h5", 0.014}, {"refined-1/model.h5", 0.002}};
    written.replay     = PlanReplay{100, {{"a", 0.1, {1., 2.}, {1., 2.}, 4e-4}, {"b", 0.1, {1.}, {1.}, 5.8e-4}}, 3.};
    write_plan_result(folder.path / "plan.json", written);
    const PlanResult read = read_plan_result(folder.path / "plan.json");
    EXPECT_EQ(read.fields.size(), 2u);
    EXPECT_EQ(read.find(optimal_field_name)->bx_T, written.fields[1].bx_T);
    EXPECT_EQ(read.fields[0].trace[1].n_periods, 30);
    EXPECT_EQ(read.fields[0].trace[1].n_evaluations, 8);
    EXPECT_TRUE(std::isnan(read.fields[0].kkt_residual)); // null in between
    EXPECT_EQ(read.trade_off[0].optimal_status, "stalled");
    EXPECT_EQ(read.warnings, written.warnings);
    ASSERT_EQ(read.refinement.size(), 2u);
    EXPECT_EQ(read.refinement[1].model_file, "refined-1/model.h5");
    EXPECT_EQ(read.refinement[1].difference, 0.002);
    ASSERT_TRUE(read.replay);
    EXPECT_EQ(read.replay->fields[1].displacement_m, std::vector<double>{1.});
    EXPECT_DOUBLE_EQ(read.gain(), 1.5);
  }

  TEST(PlanResult, OfAnEarlierVersionWasNotRefined)
  {
    const TemporaryFolder folder;
    write_plan_result(folder.path / "plan.json", {});
    Json json = read_json_file(folder.path / "plan.json", "the plan", "");
    json.erase("refinement");
    write_json_file(folder.path / "plan.json", json);
    EXPECT_TRUE(read_plan_result(folder.path / "plan.json").refinement.empty());
  }

  TEST(PlanResult, KnowsTheLargestDifferenceOfBothModels)
  {
    const PlanReplay replay{100, {{"a", 0., {3., 1.}, {1., 1.01}, 1.}, {"b", 0., {9., 2.}, {1., 1.9}, 2.}}, 1.};
    EXPECT_NEAR(replay.largest_difference(), 0.05, 1e-12); // of last periods
    const PlanReplay broken{100, {{"a", 0., {1.}, {NAN}, 1.}, {"b", 0., {1.}, {1.}, 2.}}, 1.};
    EXPECT_TRUE(std::isnan(broken.largest_difference())); // no agreement
  }

  TEST(PlanResult, SaysWhetherTheFullOrderModelAgrees)
  {
    PlanResult plan;
    EXPECT_TRUE(std::isnan(plan.gain()));
    plan.fields = {field(tuned_field_name, 4e-4), field(optimal_field_name, 6e-4)};
    EXPECT_EQ(plan.confirmation().find("not confirmed"), 0u);
    plan.replay = PlanReplay{100, {{"a", 0., {}, {}, 4e-4}, {"b", 0., {}, {}, 5.6e-4}}, 3.};
    EXPECT_EQ(plan.confirmation(),
              "confirmed: 1.4 times the tuned sinusoid on the full-order model, 1.5 times on the reduced one");
    plan.replay->fields[1].mean_speed_m_s = 5e-4;
    EXPECT_EQ(plan.confirmation().find("not confirmed"), 0u);
  }

  TEST(PlanResult, IsRefusedWhenItIsSomethingElse)
  {
    const TemporaryFolder folder;
    const auto            message = [&](const std::string &text) {
      return message_of<InputError>([&] { read_plan_result(folder.write("plan.json", text)); });
    };
    EXPECT_NE(message("{}").find("is not a plan of swimtwin optimize"), std::string::npos);
    EXPECT_NE(message("[1,").find("plan.json"), std::string::npos);
    EXPECT_THROW(read_plan_result(folder.path / "absent.json"), InputError);
    PlanResult half;
    half.replay = PlanReplay{100, {{"a", 0., {}, {}, 4e-4}, {"b", 0., {}, {}, 5.6e-4}}, 3.};
    write_plan_result(folder.path / "plan.json", half);
    Json json = Json::parse(content(folder.path / "plan.json"));
    json["replay"]["fields"].erase(1);
    EXPECT_NE(message(json.dump()).find("a replay of other than two fields"), std::string::npos);
  }
} // namespace swimtwin
