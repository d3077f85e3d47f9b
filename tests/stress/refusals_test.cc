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

  TEST(LowViscosity, IsWarnedOfWithARemedyThatWorks)
  {
    const TemporaryFolder folder;
    const ShrunkScene     scene   = hard_swimmer({"fluid.viscosity_Pa_s=1e-2"});
    const Outcome         outcome = simulate(scene, folder.path / "run", {"--quiet"});
    for (const char *part : {"warning", "unsteady group", "inertia = \"none\""})
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    expect_convergence(scene.with({"fluid.inertia=none"}));
  }
} // namespace swimtwin
