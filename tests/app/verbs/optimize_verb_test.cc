#include <app/frame/written_files.h>
#include <datasets/reduced/reduced_model.h>
#include <reports/plan/plan_files.h>
#include <tests/app/declared_files.h>
#include <tests/app/tool_in_process.h>
#include <tests/control/small_model.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace
  {
    Outcome optimize_tool(const std::vector<std::string> &arguments)
    {
      return run_in_process(arguments, {{"optimize", add_optimize}, {"report", add_report}});
    }

    const std::string a_goal = R"([objective]
mean_speed = 1
[field]
harmonics = 2
family = "symmetric"
frequency_low_Hz = 0.2
frequency_high_Hz = 1.5
sample_rate_Hz = 200
[limits]
magnitude_T = 7e-3
[search]
starts = 0
max_evaluations = 12
)";

    class OptimizeVerb : public ::testing::Test
    {
    protected:
      OptimizeVerb() { write_reduced_model(model, small_model(), Provenance{}); }

      Outcome optimize(const std::string &goal, const std::vector<std::string> &options = {}) const
      {
        std::vector<std::string> arguments = {"optimize", model, folder.write("goal.toml", goal), "--output", results};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return optimize_tool(arguments);
      }

      const TemporaryFolder folder;
      const std::string     model = folder.path / "model.h5", results = folder.path / "results";
    };

    void expect_part(const std::string &text, const std::string &part)
    {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  } // namespace

  TEST_F(OptimizeVerb, SaysThatARefinementNeedsTheFullOrderModel)
  {
    const Outcome outcome = optimize(a_goal, {"--refine", "1"});
    EXPECT_EQ(outcome.code, 2);
    expect_part(outcome.errors, "--refine needs the full-order model");
    const Outcome unreadable = optimize(a_goal, {"--refine", "1", "--refine-target", "soon"});
    EXPECT_EQ(unreadable.code, 2);
    expect_part(unreadable.errors, "--refine-target soon");
    EXPECT_FALSE(std::filesystem::exists(results));
  }

  TEST_F(OptimizeVerb, WritesFieldPlanMotionsAndPage)
  {
    const Outcome outcome = optimize(a_goal, {"--no-picture", "--trade-off", "0.6"});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    expect_part(outcome.output, "gain");
    expect_part(outcome.output, "not confirmed");
    expect_part(outcome.output, "multiplier up to 0.6");
    const PlanFolder    plan = read_plan(results);
    const PlannedField &best = *plan.plan.find(optimal_field_name);
    EXPECT_EQ(plan.motions.size(), 4u);
    EXPECT_EQ(plan.plan.trade_off.size(), 1u);
    const FieldProgram field = FieldProgram::read_csv(folder.path / "results/field.csv", 1. / best.frequency_Hz);
    EXPECT_NEAR(static_cast<double>(field.time_s().size()), 200. / best.frequency_Hz, 1.);
    expect_part(content(folder.path / "results/report.html"), "Harmonics of the optimal field");
    EXPECT_FALSE(plan.plan.provenance.scene_hash.empty());
    EXPECT_EQ(optimize_tool({"report", results, "--force"}).code, 0);
    expect_all_declared(results, written_by::optimize().patterns);
  }

  TEST_F(OptimizeVerb, ChecksItsDerivatives)
  {
    const Outcome outcome = optimize(a_goal, {"--check-gradients"});
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    expect_part(outcome.output, "magnetic_work");
    expect_part(outcome.output, "heading held: Floquet multiplier 1");
    EXPECT_FALSE(std::filesystem::exists(results));
  }

  TEST_F(OptimizeVerb, CarriesInertiaWhereTheModelHasIt)
  {
    const Outcome none = optimize(a_goal, {"--inertia", "full"});
    EXPECT_EQ(none.code, 2);
    expect_part(none.errors, "was trained without inertia");
    write_reduced_model(model, truncated(read_reduced_model(std::string(places::models) + "/reference-2d.h5"), 2),
                        Provenance{});
    const auto plan = [&](const std::string &viscosity, const std::vector<std::string> &options) {
      const Outcome outcome = optimize(a_goal + "[swimmer]\nviscosity_Pa_s = " + viscosity + "\n", options);
      EXPECT_EQ(outcome.code, 0) << outcome.errors;
      return read_plan_result(std::filesystem::path(results) / plan_name);
    };
    const PlanResult with = plan("1.0", {"--inertia", "full", "--no-picture"});
    EXPECT_EQ(with.inertia, (std::vector<std::string>{"unsteady", "convective", "tail", "head"}));
    EXPECT_EQ(with.fields.front().start.size(), 8u); // angle, two coordinates, five velocities
    const PlanResult without = plan("1.0", {"--inertia", "none", "--no-picture", "--force"});
    EXPECT_TRUE(without.inertia.empty());
    const double share = with.fields.front().mean_speed_m_s / without.fields.front().mean_speed_m_s - 1.;
    EXPECT_GT(std::abs(share), 1e-3);
    EXPECT_LT(std::abs(share), 0.2);
    ASSERT_FALSE(without.warnings.empty());
    expect_part(without.warnings.back(), "the reduced swimmer neglects inertia");
  }

  TEST_F(OptimizeVerb, RefusesToNeglectInertiaThatDecides)
  {
    const std::string thin    = a_goal + "[swimmer]\nviscosity_Pa_s = 5e-3\n";
    const Outcome     outcome = optimize(thin);
    EXPECT_EQ(outcome.code, 2);
    expect_part(outcome.errors, "lower [field] frequency_low_Hz or raise [swimmer] viscosity_Pa_s");
    EXPECT_FALSE(std::filesystem::exists(results));
  }

  // Slow fields could be planned, but the best one is fast: the plan is written and not taken for one.
  TEST_F(OptimizeVerb, FailsWhereTheFoundFrequencyNeedsInertiaThatIsLeftOut)
  {
    std::string thinner = a_goal + "[swimmer]\nviscosity_Pa_s = 0.1\n";
    thinner.replace(thinner.find("max_evaluations = 12"), 20, "max_evaluations = 60");
    const Outcome outcome = optimize(thinner, {"--no-picture"});
    EXPECT_EQ(outcome.code, 1) << outcome.errors;
    expect_part(outcome.errors, "lower [field] frequency_high_Hz or raise [swimmer] viscosity_Pa_s");
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(results) / plan_name));
    EXPECT_EQ(optimize(thinner, {"--no-picture", "--force", "--allow-inertia"}).code, 0);
  }

  TEST_F(OptimizeVerb, NeedsTheFullOrderModelForAReplay)
  {
    const Outcome outcome = optimize(a_goal, {"--replay"});
    EXPECT_EQ(outcome.code, 2);
    expect_part(outcome.errors, "--replay needs the full-order model, which this build is without");
    EXPECT_FALSE(std::filesystem::exists(results));
  }

  TEST_F(OptimizeVerb, SaysWhichLimitNoFieldMeets)
  {
    const Outcome outcome = optimize(a_goal + "gradient_free_budget = 0\n[robust]\n", {"--no-picture"});
    EXPECT_EQ(outcome.code, 2);
    expect_part(outcome.errors, "[robust] calibration is missing");
    std::string impossible = a_goal;
    impossible.replace(impossible.find("[search]"), 0, "largest_multiplier = 1e-30\n");
    const Outcome infeasible = optimize(impossible, {"--no-picture"});
    EXPECT_EQ(infeasible.code, 1);
    expect_part(infeasible.errors, "no field was found (infeasible)");
    expect_part(infeasible.errors, "heading held: Floquet multiplier");
    EXPECT_EQ(read_plan(results).plan.status, "infeasible");
  }

  TEST_F(OptimizeVerb, WarnsOfAProgramInOtherUnits)
  {
    std::string csv = "time_s,bx_T,by_T\n";
    for (int i = 0; i < 64; ++i)
      csv += std::to_string(i / 64.) + ",5," + std::to_string(5. * std::sin(2. * 3.14159265 * i / 64.)) + "\n";
    folder.write("given.csv", csv);
    std::string goal = a_goal;
    goal.replace(goal.find("[limits]"), 0, "program = \"given.csv\"\nperiod_s = 1\n");
    const Outcome outcome = optimize(goal, {"--no-picture", "--quiet"});
    expect_part(outcome.errors, "reaches 7.07 T, more than coils for swimmers give; if its columns are in mT");
  }

  TEST_F(OptimizeVerb, KeepsResultsUnlessForced)
  {
    std::filesystem::create_directories(results);
    folder.write("results/plan.json", "{}");
    const Outcome outcome = optimize(a_goal);
    EXPECT_EQ(outcome.code, 2);
    expect_part(outcome.errors, "--force");
    EXPECT_EQ(optimize_tool({"optimize", model, folder.write("goal.toml", a_goal)}).code, 2);
    EXPECT_EQ(optimize(a_goal, {"--force", "--trade-off", "much"}).code, 2);
    EXPECT_EQ(content(folder.path / "results/plan.json"), "{}");
  }
} // namespace swimtwin
