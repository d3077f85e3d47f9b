#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <cstdlib>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    Outcome simulate_on_two_ranks(const ShrunkScene &scene, const std::filesystem::path &folder)
    {
      // Open MPI: allow root, more ranks than cores, and let ranks that wait give their core away.
      setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
      setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
      setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
      std::vector<std::string> words{"mpirun", "--oversubscribe", "-n", "2"};
      for (const auto &word : tool(simulate_arguments(scene, folder)))
        words.push_back(word);
      return run(words);
    }
  } // namespace

  // gmsh turns round-off into another mesh, so the window has no remesh.
  // Two ranks add the same numbers in another order: round-off, amplified by what the linear solver leaves
  // (1e-11 of the solution, 20 steps).
  TEST(Ranks, TwoRanksMoveLikeOne)
  {
    const TemporaryFolder folder;
    const auto            scene   = coarse_swimmer(100, 0.2).with({"numerics.linear_tolerance=1e-11"});
    const Outcome         outcome = simulate_on_two_ranks(scene, folder.path);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Motion two = read_motion(folder.path), one = simulate(scene);
    EXPECT_EQ(one.trajectory.size(), 21);
    ASSERT_EQ(one.summary.n_remeshes + two.summary.n_remeshes, 0);
    const double difference = distance(one.trajectory, two.trajectory);
    std::cout << "two ranks against one: " << difference << " body lengths" << std::endl;
    EXPECT_LE(difference, 1e-8);
    EXPECT_LE(largest_angle_difference(one.trajectory, two.trajectory), 1e-8);
  }

  TEST(Ranks, FieldsOfTwoRanksAreThoseOfOne)
  {
    const TemporaryFolder folder;
    const auto            scene   = coarse_swimmer(20, 0.2).with({"output.fields_per_period=10"});
    const Outcome         outcome = simulate_on_two_ranks(scene, folder.path / "two");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    simulate(scene, folder.path / "one");
    const Outcome compared = run({places::python, "-B", std::string(places::checks) + "/compare_fields.py",
                                  folder.path / "one/fields", folder.path / "two/fields"});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_EQ(compared.out, "5\n"); // three instants of the tail, two of the fluid
  }

  TEST(Ranks, BadInputEndsBothRanksWithOneMessageAndItsExitCode)
  {
    const TemporaryFolder folder;
    const Outcome outcome = simulate_on_two_ranks(coarse_swimmer(20, 1.).with({"tail.length_m=-1"}), folder.path);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    expect_in(outcome.err, "length_m");
    EXPECT_EQ(outcome.err.find("swimtwin:"), outcome.err.rfind("swimtwin:")) << outcome.err;
  }
} // namespace swimtwin
