#include <fom/run/run_plan.h>

#include <tests/datasets/temporary_folder.h>
#include <tests/fom/shipped_scene.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    RunPlan channel_plan(std::vector<std::string> overrides)
    {
      overrides.insert(overrides.end(), {"numerics.mesh_size_m=4e-4", "numerics.mesh_size_corner_m=1.5e-4"});
      return plan_run(shipped_scene("passive-tail-channel", overrides), MPI_COMM_WORLD);
    }

    std::string why(const std::vector<PlanItem> &items, const std::string &what)
    {
      const auto item = std::find_if(items.begin(), items.end(), [&](const PlanItem &i) { return i.what == what; });
      return item == items.end() ? "not in the list" : item->why;
    }

    const std::string on_axis = "head.center_m=[0.0, 0.0]";
  } // namespace

  TEST(RunPlan, SaysWhetherHalfOfTheSceneIsSolvedAndWhy)
  {
    const RunPlan half = channel_plan({on_axis}), whole = channel_plan({on_axis, "numerics.symmetric_half=off"});
    expect_in(why(half.skipped, "lower half"), "the scene has a mirror plane");
    expect_in(why(whole.solved, "both halves"), "[numerics] symmetric_half = \"off\"");
    EXPECT_LT(half.n_unknowns, .55 * whole.n_unknowns);
    expect_in(why(channel_plan({}).solved, "both halves"), "no mirror plane: the head is not on the domain's axis");
    expect_in(why(channel_plan({on_axis, "numerics.coupling=fixed-point"}).solved, "both halves"),
              "coupling = \"fixed-point\" does not use it");
  }

  TEST(RunPlan, NamesTheSolversOfThePartitionedScheme)
  {
    const auto solvers = [](const std::vector<std::string> &settings) {
      return why(channel_plan(settings).solved, "linear systems");
    };
    EXPECT_EQ(solvers({"numerics.coupling=fixed-point"}), "factors: [numerics] coupling = \"fixed-point\"");
    expect_in(solvers({"numerics.coupling=fixed-point", "numerics.linear_solver=iterative"}),
              "GMRES with GASM (tail), CG with GAMG (mesh motion): [numerics] linear_solver");
  }

  TEST(RunPlan, WarnsOfInertiaThatTheStepsDoNotFollow)
  {
    const auto warnings = [](const std::string &viscosity, const std::string &steps) {
      const std::vector<std::string> settings = {"fluid.inertia=full", "fluid.viscosity_Pa_s=" + viscosity,
                                                 "time.steps_per_period=" + steps, "numerics.mesh_growth=0.6"};
      std::string                    text;
      for (const auto &warning : plan_run(shipped_scene("reference-2d-casefile", settings), MPI_COMM_WORLD).warnings)
        text += warning + "\n";
      return text;
    };
    expect_in(warnings("0.015", "40"), "inertia lets the swimmer swing about the field at ");
    expect_in(warnings("0.015", "40"), "raise [time] steps_per_period to ");
    EXPECT_EQ(warnings("0.015", "200"), "");
    EXPECT_EQ(warnings("1.52", "40"), "");
    expect_in(warnings("1e-4", "400"), "the Reynolds number of a cell is up to ");
  }

  TEST(RunPlan, SaysHowNearTheWallsAre)
  {
    const auto plan = [](const std::string &center_m) {
      return plan_run(shipped_scene("vessel-3d", {"variant=quick", "head.center_m=[0.0, " + center_m + "]"}),
                      MPI_COMM_WORLD);
    };
    const RunPlan far = plan("0.0"), near = plan("2.35e-3");
    EXPECT_EQ(why(far.numbers, "nearest wall"), "outer, 0.0024 m away");
    EXPECT_EQ(why(near.numbers, "nearest wall"), "outer, 5e-05 m away");
    EXPECT_TRUE(far.warnings.empty());
    ASSERT_FALSE(near.warnings.empty());
    expect_in(near.warnings.front(), "the gap of 5e-05 m to the outer wall is 8 times narrower than elements beside");
  }

  TEST(RunPlan, WarnsOfASymmetricMotionThatMayBeUnstable)
  {
    const std::vector<std::string> compressed = {on_axis, "gravity.acceleration_m_s2=[9.81, 0.0]"};
    expect_in(why(channel_plan(compressed).solved, "both halves"), "the tail's weight compresses it");
    auto insisting = compressed;
    insisting.push_back("numerics.symmetric_half=on");
    const auto warnings = channel_plan(insisting).warnings;
    ASSERT_FALSE(warnings.empty());
    expect_in(warnings.back(), "the motion is kept symmetric");
  }
} // namespace swimtwin
