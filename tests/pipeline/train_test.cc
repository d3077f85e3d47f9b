#include <tests/pipeline/simulation.h>

#include <datasets/files/json_entries.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/text/csv_table.h>

namespace swimtwin
{
  namespace
  {
    /// A coarse swimmer, few shapes: half a minute on one core.
    std::vector<std::string> train_arguments(const std::filesystem::path    &folder,
                                             const std::vector<std::string> &more   = {},
                                             const std::string              &target = "5%")
    {
      std::vector<std::string> arguments{"train"};
      const auto               scene = ShrunkScene{"open-2d"}.with(
                        {"numerics.mesh_size_m=8e-4", "numerics.mesh_size_corner_m=3e-4", "numerics.mesh_growth=0.6"});
      for (const auto &part :
           {scene.arguments(),
            {"--young-modulus", "8e4:2e5", "--frequency", "0.5:1.5", "--magnetization", "2e5", "--modes", "2",
             "--samples", "90", "--held-out", "1", "--steps", "20", "--target", target, "--output", folder.string()},
            more})
        arguments.insert(arguments.end(), part.begin(), part.end());
      return arguments;
    }

    std::size_t n_entries(const std::filesystem::path &folder)
    {
      const std::filesystem::directory_iterator all(folder);
      return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }
  } // namespace

  // Killed while it samples, gone on with, then swept: close to the full-order model even with two modes.
  TEST(Train, LeavesAModelThatSweepsAndGoesOnAfterAnInterruption)
  {
    const TemporaryFolder folder;
    const auto            results = folder.path / "model";
    ChildProcess          interrupted(tool(train_arguments(results)));
    ASSERT_TRUE(interrupted.wait_for_file(results / "samples.h5"));
    EXPECT_TRUE(interrupted.kill());
    EXPECT_FALSE(std::filesystem::exists(results / "model.h5"));
    expect_failure(run_tool(train_arguments(results)), 2, {"interrupted", "--resume", "--force"});

    const Outcome trained = run_tool(train_arguments(results, {"--resume"}));
    ASSERT_EQ(trained.exit_code, 0) << trained.err;
    const ReducedModel model = read_reduced_model(results / "model.h5");
    EXPECT_EQ(model.n_modes(), 2);
    EXPECT_FALSE(model.resistance.depends_on_angle); // the domain moves with the swimmer
    ASSERT_EQ(model.record.held_out_runs.size(), 1u);
    const HeldOutRun &run = model.record.held_out_runs.front();
    EXPECT_NEAR(run.reduced_displacement_m, run.displacement_m, .05 * run.displacement_m);
    EXPECT_NE(content(results / "model-card.txt").find("neglects"), std::string::npos);

    const Outcome swept = run_tool({"sweep", (results / "model.h5").string(), "--frequency", "0.5:0.9:5", "--output",
                                    (folder.path / "sweep").string()});
    ASSERT_EQ(swept.exit_code, 0) << swept.err;
    EXPECT_EQ(CsvTable::read(folder.path / "sweep" / "displacement_frequency.csv").n_rows(), 5u);
    expect_failure(run_tool(train_arguments(results)), 2, {"model.h5", "--force"});
    const std::vector<std::string> of_another[] = {{"--set", "tail.poisson_ratio=0.3"}, {"--by", "0:3e-3"}};
    for (auto another : of_another)
    {
      another.push_back("--resume");
      expect_failure(run_tool(train_arguments(results, another)), 2, {"--resume", "model.h5", "of another scene"});
    }
    std::filesystem::remove(results / "model.h5");
    expect_failure(run_tool(train_arguments(results, {"--set", "tail.poisson_ratio=0.3", "--resume"})), 2,
                   {"--resume", "run-01", "of another scene"});
  }

  // The same runs and samples cannot be good to a part in a million.
  TEST(Train, KeepsAModelThatMissesItsTargetAndSaysSo)
  {
    const TemporaryFolder folder;
    const auto            results = folder.path / "model";
    expect_failure(
        run_tool(train_arguments(results, {"--basis", "elastic", "--followers", "3", "--budget", "1s"}, "1e-6")), 1,
        {"model.h5", "misses its target"});
    EXPECT_EQ(content(results / "model-card.txt").find("MISSED"), 0u);
    EXPECT_EQ(read_reduced_model(results / "model.h5").record.target, 1e-6);
    EXPECT_NE(run_tool({"sweep", (results / "model.h5").string(), "--output", (folder.path / "sweep").string()})
                  .err.find("misses its target"),
              std::string::npos);
  }

  TEST(Train, OnDisplacementModesOfItsRuns)
  {
    const TemporaryFolder folder;
    const auto            results = folder.path / "model";
    const Outcome         trained = run_tool(train_arguments(results, {"--basis", "pod", "--budget", "1s"}, "10%"));
    ASSERT_EQ(trained.exit_code, 0) << trained.err;
    const ReducedModel model = read_reduced_model(results / "model.h5");
    EXPECT_FALSE(model.tail.amplitudes.are_given());
    EXPECT_GT(model.tail.followers.rows(), 0);
    EXPECT_EQ(model.resistance.half_fits.size(), 2u);
    EXPECT_NE(content(results / "model-card.txt").find("CPU time: "), std::string::npos);
  }

  // The domain moves along off the head's axis: bending towards the near wall is felt more than away from it.
  TEST(Train, TakesNoMirrorForGrantedOffTheAxis)
  {
    const TemporaryFolder folder;
    const auto            results = folder.path / "model";
    const Outcome         trained = run_tool(train_arguments(
                results, {"--set", "domain.radius_m=16e-3", "--set", "domain.center_m=[4e-3, 9e-3]", "--allow-inertia"}));
    ASSERT_EQ(trained.exit_code, 0) << trained.err;
    const ReducedModel      model      = read_reduced_model(results / "model.h5");
    const ReducedResistance resistance = model.resistance;
    EXPECT_NE(resistance.factor_at_rest(1, 0), 0.); // a force along the axis pushes it across
    Eigen::Index at_bend = 0;
    while (at_bend < resistance.exponents.rows() &&
           (resistance.exponents(at_bend, 0) != 1 || resistance.exponents.row(at_bend).sum() != 1))
      ++at_bend;
    ASSERT_LT(at_bend, resistance.exponents.rows());
    EXPECT_NE(resistance.coefficients(at_bend, 0), 0.); // drag along the axis is not even in the bend
    const HeldOutRun &run = model.record.held_out_runs.front();
    EXPECT_NEAR(run.reduced_displacement_m, run.displacement_m, .02 * run.displacement_m);
  }

  // Two modes and few samples of a swimmer that is to do what none can: fit, samples, a mode and runs are added, and it
  // is said.
  TEST(Train, AimsUntilItsBudgetIsSpent)
  {
    const TemporaryFolder folder;
    const auto            results = folder.path / "model";
    expect_failure(run_tool(train_arguments(results, {"--budget", "600s"}, "1e-5")), 1, {"misses its target"});
    const auto history = read_reduced_model(results / "model.h5").record.history;
    ASSERT_GE(history.size(), 4u); // the first model, one more at least, the time, the end
    EXPECT_EQ(history[0].find("2 modes, 9"), 0u) << history[0];
    EXPECT_NE(history.back().find("It ended because neither more samples, another mode nor more runs"),
              std::string::npos)
        << history.back();
    EXPECT_GE(n_entries(results / "runs"), 10u); // one near the one that is held out, beside the nine of the design
    expect_failure(run_tool(train_arguments(results, {"--budget", "1s", "--resume"}, "1e-5")), 1,
                   {"misses its target"}); // the samples and runs are there already
    const auto spent = read_reduced_model(results / "model.h5").record.history;
    EXPECT_NE(spent.back().find("It ended because what is left of the --budget of 1 s"), std::string::npos)
        << spent.back();
  }

  // The plan's own shapes are trained on, and known full-order runs are not made again.
  TEST(Train, FollowsItsUseWhereAPlanAsksForIt)
  {
    const TemporaryFolder folder;
    const std::string     first = folder.path / "model" / "model.h5", results = folder.path / "plan";
    ASSERT_EQ(run_tool(train_arguments(folder.path / "model")).exit_code, 0);
    const std::string goal = folder.write("goal.toml", brief_goal());
    const Outcome     outcome =
        run_tool({"optimize", first, goal, "--refine", "2", "--refine-target", "0.0001%", "--inertia", "none",
                  "--replay-periods", "2", "--replay-steps", "80", "--no-picture", "--output", results});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("after 2 of 2 refinements the models differ by"), std::string::npos) << outcome.err;
    const Json plan = read_json_file(folder.path / "plan" / "plan.json", "the plan", "");
    ASSERT_EQ(plan.at("refinement").size(), 3u);
    const std::string refined = folder.path / "plan" / "refined-2" / "model.h5";
    EXPECT_EQ(plan.at("model_file"), refined);
    EXPECT_EQ(plan.at("refinement")[2].at("model_file"), refined);
    // Two modes are some 1 % off, and the first round may move the plan by as much.
    EXPECT_LT(plan.at("refinement")[2].at("difference"), plan.at("refinement")[0].at("difference"));

    const TrainingRecord before = read_reduced_model(first).record, after = read_reduced_model(refined).record;
    EXPECT_GT(after.n_snapshots, before.n_snapshots);
    ASSERT_EQ(after.held_out_runs.size(), 1u);
    EXPECT_EQ(after.held_out_runs[0].displacement_m, before.held_out_runs[0].displacement_m);
    EXPECT_NE(after.held_out_runs[0].reduced_displacement_m, before.held_out_runs[0].reduced_displacement_m);
    EXPECT_FALSE(std::filesystem::exists(folder.path / "plan" / "refined-2" / "held-out"));
    EXPECT_TRUE(std::filesystem::exists(folder.path / "plan" / "refined-2" / "shapes" / "4.h5"));
  }

  TEST(Train, RefusesWhatTheReducedSwimmerCannotBe)
  {
    const auto refuse = [](const std::vector<std::string> &arguments, const std::vector<std::string> &parts) {
      std::vector<std::string> all{"train"};
      all.insert(all.end(), arguments.begin(), arguments.end());
      all.insert(all.end(), {"--output", "unused"});
      expect_failure(run_tool(all), 2, parts);
    };
    refuse({"rigid-swimmer"}, {"cannot be trained", "[tail]"});
    refuse({"open-2d", "--set", "tail.law=\"neo-hookean\"", "--basis", "pod"}, {"st-venant-kirchhoff", "--basis"});
    refuse({"open-2d", "--set", "tail.law=\"rigid\""}, {"cannot be trained", "rigid"});
    refuse({"open-2d", "--target", "none"}, {"--target"});
    refuse({"open-2d", "--budget", "30"}, {"--budget = 30", "unit of time", "30min"});
    refuse({"open-2d", "--budget", "-5min"}, {"--budget"});
    refuse({"open-2d", "--followers", "3"}, {"--followers", "--basis bending", "leave it out"});
    refuse({"open-2d", "--set", "field.ramp_s=0.5"}, {"ramp_s", "take it out"});
    refuse({"open-2d", "--set", "fluid.inertia=\"none\"", "--frequency", "0.1:30"},
           {"unsteady group", "--allow-inertia"});
    refuse({"open-2d", "--young-modulus", "-1:2"}, {"--young-modulus"});
    refuse({"open-2d", "--young-modulus", "soft"}, {"--young-modulus"});
    refuse({"open-2d", "--snapshots", "nothing.h5"}, {"nothing.h5"});
    refuse({"reference-3d-paper", "--basis", "pod"}, {"three dimensions", "--basis"});
    refuse({"reference-3d-paper", "--set", "field.bz_T=1e-3"}, {"cannot be trained", "bz_T"});
    refuse({"reference-3d-paper", "--set", "numerics.symmetric_half=\"off\""}, {"cannot be trained", "symmetric_half"});
    EXPECT_FALSE(std::filesystem::exists("unused"));
  }

  TEST(Train, RefusesSnapshotsOfAnotherTailMeshBeforeItsRuns)
  {
    const TemporaryFolder folder;
    ASSERT_EQ(simulate(coarse_swimmer(20, 0.1).with({"numerics.mesh_size_m=6e-4"}), folder.path / "run").exit_code, 0);
    const auto model = folder.path / "model";
    for (const char *basis : {"bending", "pod", "elastic"})
      expect_failure(run_tool(train_arguments(
                         model, {"--basis", basis, "--snapshots", (folder.path / "run/snapshots.h5").string()})),
                     2, {"run/snapshots.h5", "another tail mesh"});
    EXPECT_FALSE(std::filesystem::exists(model / "runs"));
  }
} // namespace swimtwin
