#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <csignal>
#include <cstdlib>
#include <iostream>

namespace swimtwin
{
  namespace
  {
    std::vector<std::string> words_for_ranks(const std::vector<std::string> &arguments, const int n_ranks = 2)
    {
      // Open MPI: allow root, more ranks than cores, and let ranks that wait give their core away.
      setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
      setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
      setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
      std::vector<std::string> words{"mpirun", "--oversubscribe", "-n", std::to_string(n_ranks)};
      for (const auto &word : tool(arguments))
        words.push_back(word);
      return words;
    }

    Outcome run_on_two_ranks(const std::vector<std::string> &arguments)
    {
      return run(words_for_ranks(arguments));
    }

    /// 20 steps to round-off, against the motion on one rank.
    void expect_ranks_to_move_like_one(const ShrunkScene &scene, const int n_ranks, const Motion &one)
    {
      const TemporaryFolder folder;
      const Outcome         outcome = run(words_for_ranks(simulate_arguments(scene, folder.path), n_ranks));
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      const Motion several = read_motion(folder.path);
      EXPECT_EQ(one.trajectory.size(), 21);
      ASSERT_EQ(one.summary.n_remeshes + several.summary.n_remeshes, 0);
      const double difference = distance(one.trajectory, several.trajectory);
      std::cout << n_ranks << " ranks against one: " << difference << " body lengths" << std::endl;
      EXPECT_LE(difference, 1e-8);
      EXPECT_LE(largest_angle_difference(one.trajectory, several.trajectory), 1e-8);
    }

    /// One of two ranks is killed after the first checkpoint.
    void expect_end_and_resume_without(const std::size_t missing, const ShrunkScene &scene, const Motion &whole)
    {
      const TemporaryFolder folder;
      const auto            run = folder.path / "run";
      {
        ChildProcess process(words_for_ranks(simulate_arguments(scene, run)));
        ASSERT_TRUE(process.wait_for_file(run / "checkpoint.h5"));
        const auto ranks = process.children();
        ASSERT_EQ(ranks.size(), 2u);
        ASSERT_EQ(::kill(ranks[missing], SIGKILL), 0);
        EXPECT_FALSE(process.wait_until([] { return false; })); // ends by itself, or after a minute
        ASSERT_TRUE(process.children().empty());
        EXPECT_NE(process.wait().exit_code, 0);
      }
      EXPECT_FALSE(std::filesystem::exists(run / "summary.json"));
      const Outcome resumed = run_on_two_ranks(simulate_arguments(scene, run, {"--resume"}));
      EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
      EXPECT_LE(distance(read_motion(run).trajectory, whole.trajectory), 1e-8);
      EXPECT_EQ(n_files(run), 4u);
    }

    /// What is left is mpirun's own report of an exit code that is not 0.
    void expect_one_sentence_and_an_end_in_order(const Outcome &outcome, const int exit_code, const std::string &part)
    {
      EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
      EXPECT_EQ(outcome.err.substr(0, 10), "swimtwin: ") << outcome.err;
      EXPECT_EQ(outcome.err.rfind("swimtwin: "), 0) << outcome.err;
      expect_in(outcome.err, part);
      EXPECT_EQ(outcome.err.find("MPI_ABORT"), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.err.find("finalize"), std::string::npos) << outcome.err;
    }
  } // namespace

  // gmsh turns round-off into another mesh, so the window has no remesh.
  // Two ranks add the same numbers in another order: round-off, amplified by what the linear solver leaves
  // (1e-11 of the solution, 20 steps).
  TEST(Ranks, TwoRanksMoveLikeOne)
  {
    for (const char *inertia : {"fluid.inertia=none", "fluid.inertia=full"})
    {
      SCOPED_TRACE(inertia);
      const auto scene = coarse_swimmer(100, 0.2).with({"numerics.linear_tolerance=1e-11", inertia});
      expect_ranks_to_move_like_one(scene, 2, simulate(scene));
    }
  }

  // Factors reach 1e-9 here, not 1e-11, for round-off: the stiff tail's forces cancel in a rigid motion.
  TEST(Ranks, TwoAndFourRanksMoveLikeOneInSpace)
  {
    const auto   scene = coarse_swimmer_in_space(0.5).with({"numerics.linear_tolerance=1e-11"});
    const Motion one   = simulate(scene);
    for (const int n_ranks : {2, 4})
      expect_ranks_to_move_like_one(scene, n_ranks, one);
  }

  // The other one waits for what never comes: mpirun ends it, and what the writer kept is enough to go on.
  TEST(Ranks, AMissingRankEndsTheRunWhichGoesOnFromItsCheckpoint)
  {
    const ShrunkScene scene = coarse_swimmer(40, 0.5).with({"numerics.linear_tolerance=1e-11"});
    const Motion      whole = simulate(scene);
    for (const std::size_t missing : {0, 1})
      expect_end_and_resume_without(missing, scene, whole);
  }

  TEST(Ranks, AMissingRankEndsTheRunInSpaceToo)
  {
    const ShrunkScene scene = coarse_swimmer_in_space(0.25).with({"numerics.linear_tolerance=1e-11"});
    expect_end_and_resume_without(1, scene, simulate(scene));
  }

  TEST(Ranks, FieldsOfTwoRanksAreThoseOfOne)
  {
    const TemporaryFolder folder;
    const auto            scene   = coarse_swimmer(20, 0.2).with({"output.fields_per_period=10"});
    const Outcome         outcome = run_on_two_ranks(simulate_arguments(scene, folder.path / "two"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    simulate(scene, folder.path / "one");
    const Outcome compared = run({places::python, "-B", std::string(places::checks) + "/compare_fields.py",
                                  folder.path / "one/fields", folder.path / "two/fields"});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_EQ(compared.out, "5\n"); // three instants of the tail, two of the fluid
  }

  TEST(Ranks, MistakesThatAllRanksSeeEndInOrderWithOneSentence)
  {
    const TemporaryFolder folder;
    const ShrunkScene     scene = coarse_swimmer(20, 1.);
    expect_one_sentence_and_an_end_in_order(
        run_on_two_ranks(simulate_arguments(scene.with({"tail.length_m=-1"}), folder.path)), 2, "length_m");
    expect_one_sentence_and_an_end_in_order(run_on_two_ranks({"swimulate"}), 2, "simulate");
    expect_one_sentence_and_an_end_in_order(run_on_two_ranks({"sweep", "no-such-model", "--output", folder.path}), 2,
                                            "no-such-model");
  }

  TEST(Ranks, MistakesThatOneRankSeesEndInOrderToo)
  {
    const TemporaryFolder folder;
    folder.write("trajectory.csv", "an earlier result");
    folder.write("plan.txt", "an earlier result");
    folder.write("resistance.json", "an earlier result");
    const ShrunkScene scene = coarse_swimmer(20, 1.);
    expect_one_sentence_and_an_end_in_order(run_on_two_ranks(simulate_arguments(scene, folder.path)), 2, "--force");
    for (const char *verb : {"plan", "resistance"})
    {
      std::vector<std::string> arguments{verb, "--output", folder.path};
      for (const std::string &word : scene.arguments())
        arguments.push_back(word);
      expect_one_sentence_and_an_end_in_order(run_on_two_ranks(arguments), 2, "--force");
    }
  }

  TEST(Ranks, OnlyTheFirstSpeaksWhereOneIsEnough)
  {
    const TemporaryFolder folder;
    EXPECT_EQ(run_on_two_ranks({"--version"}).out, run_tool({"--version"}).out);
    const Outcome outcome = run_on_two_ranks({"reconstruct", "reference-2d", "--flow", "--instants", "3", "--set",
                                              "time.periods=1", "--output", folder.path});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(std::filesystem::exists(folder.path / "fields"));
  }
} // namespace swimtwin
