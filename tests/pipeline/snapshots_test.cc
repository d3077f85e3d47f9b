#include <tests/pipeline/simulation.h>
#include <tests/places.h>

namespace swimtwin
{
  namespace
  {
    constexpr int    module_is_missing = 77;
    constexpr double length_m = 7.5e-3, root_m = 1.5e-3, tip_m = 0.2e-3;
  } // namespace

  TEST(Snapshots, AgreeWithTheTrajectoryAndWithTheTailsGeometry)
  {
    const TemporaryFolder folder;
    // A flat tip has straight sides only: its area is exact on any mesh.
    simulate(coarse_swimmer(20, 1.).with({"tail.tip=flat", "output.snapshots_per_period=10"}), folder.path);
    const double  area    = 0.5 * length_m * (root_m + tip_m);
    const Outcome outcome = run({places::python, "-B", std::string(places::checks) + "/check_snapshots.py", folder.path,
                                 std::to_string(area * 1e12) + "e-12", "11"});
    if (outcome.exit_code == module_is_missing)
      GTEST_SKIP() << "the module h5py is missing";
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  }
} // namespace swimtwin
