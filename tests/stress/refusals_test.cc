#include <tests/stress/hard_swimmers.h>

namespace swimtwin
{
  // St Venant-Kirchhoff has no resistance to being crushed; the message says so, and what it recommends works.
  TEST(CrushedTail, IsRefusedWithARemedyThatWorks)
  {
    const TemporaryFolder folder;
    const ShrunkScene     scene = hard_swimmer({"tail.young_modulus_Pa=1e2"});
    expect_failure(run_tool(simulate_arguments(scene, folder.path / "run")), 1,
                   {"t = ", "turned inside out", "St Venant-Kirchhoff", "neo-hookean"});
    expect_convergence(scene.with({"tail.law=neo-hookean"}));
  }

  // Only the fixed point leaves inertia out of a scene that leaves the decision to the tool.
  TEST(LowViscosity, WithoutItsInertiaIsWarnedOfWithRemediesThatWork)
  {
    const TemporaryFolder folder;
    const ShrunkScene     scene = hard_swimmer({"fluid.viscosity_Pa_s=1e-2", "fluid.inertia=auto"});
    const Outcome         outcome =
        simulate(scene.with({"numerics.coupling=fixed-point", "time.periods=0.1"}), folder.path / "run", {"--quiet"});
    for (const char *part : {"warning", "inertia is left out", "coupling = \"monolithic\"", "inertia = \"none\""})
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    expect_convergence(scene);
    expect_convergence(scene.with({"fluid.inertia=none"}));
  }
} // namespace swimtwin
