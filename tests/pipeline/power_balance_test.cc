#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    class PowerBalance : public testing::TestWithParam<const char *>
    {
    };
  } // namespace

  TEST_P(PowerBalance, ClosesToHalfAPercentWithTheSettingsAsShipped)
  {
    const Motion motion = simulate({GetParam(), {"time.periods=1", "time.steps_per_period=100"}});
    EXPECT_LE(std::abs(motion.summary.power_imbalance.value()), 0.005);
    EXPECT_NE(motion.summary.power_imbalance.value(), 0.);
  }

  TEST(PowerBalanceOfAStart, AcrossTheFieldClosesLikeASmoothOne)
  {
    const auto            across = coarse_swimmer(80, 1.).with({"head.angle_rad=1.5707963267948966"});
    const TemporaryFolder folder;
    EXPECT_EQ(simulate(across, folder.path, {"--quiet"}).err, ""); // no warning
    EXPECT_LE(std::abs(read_motion(folder.path).summary.worst_power_imbalance.value()),
              0.005 * 100. * 100. / (80. * 80.));
  }

  TEST(PowerBalanceOfAStart, AcrossTheFieldWithInertiaClosesToo)
  {
    const auto across = coarse_swimmer(100, 1.).with({"head.angle_rad=1.5707963267948966", "fluid.inertia=full"});
    EXPECT_LE(std::abs(simulate(across).summary.worst_power_imbalance.value()), 0.005);
  }

  // The field swings round between two steps: powers at their ends do not tell what happened in between.
  TEST(PowerBalanceOfARun, OpenBalanceIsWarnedOfWithItsReason)
  {
    const TemporaryFolder folder;
    std::string           jump = "time_s,bx_T,by_T\n";
    for (int k = 0; k < 4000; ++k)
      jump += std::to_string(1e-3 * k) + (k <= 1000 ? ",5e-3,0\n" : ",0,5e-3\n");
    folder.write("jump.csv", jump);
    std::string text  = content(std::string(places::scenes) + "/reference-2d-casefile.toml");
    const auto  field = text.find("[field]"), next = text.find("[time]");
    text.replace(field, next - field, "[field]\nprogram = \"jump.csv\"\nperiod_s = 4.0\n");
    ShrunkScene scene     = coarse_swimmer(100, 1.);
    scene.name            = folder.write("jump.toml", text);
    const Outcome outcome = simulate(scene, folder.path / "run", {"--quiet"});
    expect_in(outcome.err, "warning: the power balance is open by");
    expect_in(outcome.err, "in period 1, more than the 0.5 % that steps of this size explain");
    expect_in(outcome.err, "raise [time] steps_per_period");
    expect_in(content(folder.path / "run/summary.json"), "the power balance is open by");
  }

  // Cells of Reynolds number 1600: without stabilisation the coupling fails at 0.67 s.
  TEST(PowerBalanceOfARun, CountsWhatKeepsStreamsSmoothAndWarnsOfIt)
  {
    const TemporaryFolder folder;
    const Outcome         outcome = simulate({"cfd3",
                                              {"variant=quick", "fluid.viscosity_Pa_s=0.1", "time.duration_s=0.8",
                                               "time.steps=160", "domain.walls.left.ramp_s=0.3"}},
                                             folder.path, {"--quiet"});
    expect_in(outcome.err, "the mesh is too coarse for the flow's Reynolds number");
    expect_in(outcome.err, "lower [numerics] mesh_size_m and mesh_size_far_m");
    const WorkBalance balance = read_motion(folder.path).summary.work_of_last_period.value();
    EXPECT_GT(balance.stabilization_J_m, 0.1 * balance.dissipated_J_m);
    EXPECT_NEAR(balance.missing_J_m(), balance.numerical_J_m, 0.01 * balance.dissipated_J_m);
    expect_in(content(folder.path / "trajectory.csv"), "stabilization_W_m");
  }

  TEST(ShortRun, HasNoFiguresOfAPeriod)
  {
    const TemporaryFolder folder;
    const Outcome         outcome = simulate(coarse_swimmer(20, 0.2), folder.path);
    expect_in(outcome.out, "no displacement per period: no full period of");
    expect_in(outcome.out, "no power imbalance: no full period was computed");
    const RunSummary summary = read_motion(folder.path).summary;
    EXPECT_EQ(summary.status, "completed");
    EXPECT_TRUE(summary.displacement_per_period_m.empty());
    EXPECT_FALSE(summary.net_displacement_m.has_value());
    EXPECT_FALSE(summary.power_imbalance.has_value());
    expect_in(content(folder.path / "summary.json"), "\"net_displacement_m\": null");
  }

  INSTANTIATE_TEST_SUITE_P(ReferenceScenes, PowerBalance,
                           testing::Values("reference-2d-paper", "reference-2d-casefile"),
                           [](const auto &test) { return test.index == 0 ? "Paper" : "Casefile"; });
} // namespace swimtwin
