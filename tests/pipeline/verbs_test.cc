#include <tests/datasets/example_surfaces.h>
#include <tests/pipeline/simulation.h>

#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include <regex>

namespace swimtwin
{
  namespace
  {
    const ShrunkScene short_run = coarse_swimmer(20, 0.1);

    Outcome run_verb(const std::string &verb, const ShrunkScene &scene, const std::vector<std::string> &options)
    {
      std::vector<std::string> arguments{verb};
      for (const auto &more : {scene.arguments(), options})
        arguments.insert(arguments.end(), more.begin(), more.end());
      return run_tool(arguments);
    }

    Eigen::Matrix3d resistance(const std::vector<std::string> &settings)
    {
      const TemporaryFolder folder;
      const Outcome outcome = run_verb("resistance", short_run.with(settings), {"--output", folder.path.string()});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      const auto      json = nlohmann::json::parse(content(folder.path / "resistance.json"));
      Eigen::Matrix3d matrix;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          matrix(i, j) = json["matrix"][i][j];
      EXPECT_EQ(json["order"], (nlohmann::json{"Ux", "Uy", "omega"}));
      EXPECT_TRUE(json["provenance"].contains("scene_hash"));
      return matrix;
    }

    /// Lengths scaled away, so that eigenvalues of entries with different units can be compared.
    Eigen::Matrix3d without_units(const Eigen::Matrix3d &matrix)
    {
      const Eigen::Vector3d scale(1., 1., 1. / body_length_m);
      return scale.asDiagonal() * matrix * scale.asDiagonal();
    }
  } // namespace

  TEST(Verbs, EveryOneExplainsItself)
  {
    for (const std::vector<std::string> &arguments : {std::vector<std::string>{"--help"},
                                                      {"plan", "--help"},
                                                      {"simulate", "--help"},
                                                      {"resistance", "--help"},
                                                      {"train", "--help"},
                                                      {"sweep", "--help"},
                                                      {"demo", "--help"}})
    {
      const Outcome outcome = run_tool(arguments);
      EXPECT_EQ(outcome.exit_code, 0);
      EXPECT_GT(outcome.out.size(), 100);
      EXPECT_EQ(outcome.err, "");
    }
    EXPECT_EQ(run_tool({"--version"}).exit_code, 0);
  }

  TEST(Verbs, UnknownOnesUnknownOptionsAndMissingArgumentsAreRefused)
  {
    expect_failure(run_tool({"swim"}), 2, {"swim", "--help"});
    expect_failure(run_tool({}), 2, {"--help"});
    expect_failure(run_tool({"simulate", "open-2d", "--output", "unused", "--fast"}), 2, {"--fast", "--help"});
    expect_failure(run_tool({"simulate", "open-2d"}), 2, {"--output", "--help"});
    expect_failure(run_tool({"simulate", "--output", "unused"}), 2, {"scene", "--help"});
    expect_failure(run_tool({"simulate", "open-2d", "--output"}), 2, {"--output", "--help"});
    EXPECT_FALSE(std::filesystem::exists("unused"));
  }

  TEST(Verbs, PlanSaysWhatARunTakesAndWritesNothing)
  {
    const TemporaryFolder folder;
    const Outcome         outcome = run_verb("plan", short_run, {});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char *part : {"unknowns", "steps", "time", "memory", "Skipped"})
      expect_in(outcome.out, part);
    EXPECT_EQ(run_verb("plan", short_run, {"--output", folder.path.string()}).exit_code, 0);
    EXPECT_EQ(n_files(folder.path), 1) << "more than plan.txt";
  }

  TEST(Verbs, PlanFindsTheUnknownsThatTheRunSolves)
  {
    const Outcome outcome = run_verb("plan", short_run, {});
    const Motion  motion  = simulate(short_run);
    // Appended, not added to a literal: there GCC 12 sees an overlap that is not.
    std::string line = std::to_string(motion.summary.n_unknowns);
    line.append("\n");
    expect_in(outcome.out, line);
  }

  TEST(Verbs, ResistanceIsSymmetricPositiveDefiniteAndProportionalToViscosity)
  {
    const Eigen::Matrix3d matrix = without_units(resistance({}));
    EXPECT_LE((matrix - matrix.transpose()).norm(), 1e-9 * matrix.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix).eigenvalues().minCoeff(), 0.);
    const Eigen::Matrix3d twice = without_units(resistance({"fluid.viscosity_Pa_s=3.04"}));
    EXPECT_LE((twice - 2. * matrix).norm(), 1e-9 * twice.norm());
    // A slender body resists sideways motion more than lengthwise motion.
    EXPECT_GT(matrix(1, 1), matrix(0, 0));
  }

  TEST(Verbs, ResistanceNeedsAWallThatHoldsTheFluid)
  {
    const TemporaryFolder folder;
    expect_failure(run_verb("resistance",
                            short_run.with({"fluid.inertia=full", "domain.walls.top=traction-free",
                                            "domain.walls.bottom=traction-free"}),
                            {"--output", (folder.path / "matrix").string()}),
                   2, {"[domain.walls] leaves every wall traction-free", "no-slip"});
  }

  // Of factors that are kept beside new ones, too, which short runs do not have.
  TEST(Verbs, PlanTellsTheMemoryThatARunTakes)
  {
    for (const ShrunkScene &scene :
         {short_run, coarse_swimmer_in_space(.05), ShrunkScene{"vessel-3d", {"variant=quick"}},
          ShrunkScene{"settling-sphere", {"variant=quick"}}})
    {
      SCOPED_TRACE(scene.name);
      const TemporaryFolder folder;
      const Outcome         plan = run_verb("plan", scene, {});
      std::smatch           memory;
      ASSERT_TRUE(std::regex_search(plan.out, memory, std::regex("memory +([0-9.]+) MB"))) << plan.out;
      ASSERT_EQ(run_verb("simulate", scene, {"--output", folder.path.string(), "--quiet"}).exit_code, 0);
      const double taken_MB = read_run_summary_json(folder.path / "summary.json").summary.peak_memory_MB;
      EXPECT_GE(std::stod(memory[1]), .9 * taken_MB);
      EXPECT_LE(std::stod(memory[1]), 2. * taken_MB);
    }
  }

  TEST(Verbs, ElementsInsideOutAreRefusedWithTheMeshSizeToUse)
  {
    const ShrunkScene coarse{
        "rotating-disc",
        {"numerics.mesh_size_m=4e-3", "numerics.mesh_size_corner_m=4e-3", "numerics.mesh_size_far_m=4e-3"}};
    for (const char *verb : {"plan", "simulate", "resistance"})
    {
      const TemporaryFolder folder;
      const Outcome         outcome = run_verb(verb, coarse, {"--output", (folder.path / "run").string()});
      expect_failure(outcome, 2,
                     {"rotating-disc: [numerics] mesh_size_m = 0.004 m", "inside out at (", "set mesh_size_m = "});
      EXPECT_FALSE(std::filesystem::exists(folder.path / "run/resistance.json"));
    }
  }

  // A wave of bending begins bent: its first mesh is no matter of a step.
  TEST(Verbs, ElementsInsideOutAroundABentStartAreRefused)
  {
    const ShrunkScene     wave{"waving-swimmer",
                           {"numerics.mesh_size_m=4e-3", "numerics.mesh_size_corner_m=4e-3",
                                "numerics.mesh_size_far_m=8e-3", "tail.wave.angle_rad=2.0", "tail.wave.waves=2.0"}};
    const TemporaryFolder folder;
    expect_failure(run_verb("simulate", wave, {"--output", (folder.path / "run").string()}), 2,
                   {"waving-swimmer: the fluid's mesh has an element inside out at (", "lower [numerics] mesh_size_m"});
    EXPECT_FALSE(std::filesystem::exists(folder.path / "run/summary.json"));
  }

  // A plate of triangles 100 times as long as wide at its rim.
  TEST(Verbs, ResistanceWarnsOfSlivers)
  {
    const TemporaryFolder folder;
    folder.write("plate.stl", stl_text(example_box({2., 2., .02})));
    const std::string scene   = folder.write("plate.toml", R"(
dimension = 3
[fluid]
density_kg_m3 = 1000.0
viscosity_Pa_s = 1.0
inertia = "none"
[domain]
shape = "sphere"
radius_m = 20e-3
[head]
shape = "surface"
surface = "plate.stl"
surface_unit_m = 1e-3
motion = "fixed"
[time]
duration_s = 1.0
steps = 1
[numerics]
mesh_growth = 0.8
mesh_size_far_m = 6e-3
)");
    const Outcome     outcome = run_tool({"resistance", scene, "--output", folder.path / "results"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_in(outcome.err, "warning: plate.stl has a triangle of quality 0.017");
    const auto warnings = nlohmann::json::parse(content(folder.path / "results/resistance.json"))["warnings"];
    ASSERT_EQ(warnings.size(), 1u);
    expect_in(warnings[0], "the flow is inaccurate at slivers below 0.05");
  }

  TEST(Verbs, QuietOnesPrintNothing)
  {
    for (const char *verb : {"plan", "simulate", "resistance"})
    {
      const TemporaryFolder folder;
      const Outcome outcome = run_verb(verb, short_run, {"--output", (folder.path / "run").string(), "--quiet"});
      EXPECT_EQ(outcome.exit_code, 0);
      EXPECT_EQ(outcome.out + outcome.err, "") << verb;
    }
  }

  TEST(Verbs, WithoutATerminalThereIsNoProgressBar)
  {
    const TemporaryFolder folder;
    const Outcome         outcome = simulate(short_run, folder.path);
    EXPECT_EQ(outcome.err, "");
    expect_in(outcome.out, "power imbalance");
  }

  TEST(Verbs, DemoSwimsTheReferenceSwimmer)
  {
    const TemporaryFolder folder;
    const Outcome outcome = run_tool({"demo", "--output", folder.path / "run", "--set", "time.periods=1", "--set",
                                      "time.steps_per_period=20", "--set", "numerics.mesh_growth=1"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder.path / "run/trajectory.csv"));
    expect_in(outcome.out, "displacement");
  }
} // namespace swimtwin
