#include <tests/pipeline/simulation.h>

#include <iostream>

namespace swimtwin
{
  namespace
  {
    // A checkpoint is written ten times a period: here every fourth step. Remeshing stands for the mesh's history.
    const ShrunkScene scene = coarse_swimmer(40, 1.).with({"numerics.remesh_every_steps=15"});

    /// What resuming may change: nothing but round-off, which the coupling and linear tolerances hide.
    constexpr double tolerance = 1e-9;

    enum class Moment { before_first_checkpoint, after_first_checkpoint };

    /// Start a run and kill -9 it.
    void interrupt(const ShrunkScene &what, const std::filesystem::path &folder, const Moment moment)
    {
      ChildProcess run(tool(simulate_arguments(what, folder)));
      const bool   checkpoint = moment == Moment::after_first_checkpoint;
      ASSERT_TRUE(run.wait_for_file(checkpoint ? folder / "checkpoint.h5" : folder));
      ASSERT_TRUE(run.kill());
      ASSERT_FALSE(std::filesystem::exists(folder / "trajectory.csv"));
      ASSERT_EQ(std::filesystem::exists(folder / "checkpoint.h5"), checkpoint);
    }

    /// Start a run and kill -9 it when it has written its first checkpoint, or the one after.
    void interrupt_after(const int n_checkpoints, const ShrunkScene &what, const std::filesystem::path &folder)
    {
      ChildProcess      run(tool(simulate_arguments(what, folder)));
      const std::string file = folder / "checkpoint.h5";
      ASSERT_TRUE(run.wait_for_file(file));
      std::error_code ignored;
      const auto      first = std::filesystem::last_write_time(file, ignored);
      if (n_checkpoints > 1)
      {
        ASSERT_TRUE(run.wait_until([&] { return std::filesystem::last_write_time(file, ignored) != first; }));
      }
      ASSERT_TRUE(run.kill());
    }

    void expect_the_uninterrupted_motion(const std::filesystem::path &folder, const ShrunkScene &what = scene)
    {
      const Motion whole = simulate(what), resumed = read_motion(folder);
      const double difference = distance(resumed.trajectory, whole.trajectory);
      std::cout << "resumed against uninterrupted: " << difference << " body lengths" << std::endl;
      EXPECT_LE(difference, tolerance);
      EXPECT_LE(largest_angle_difference(resumed.trajectory, whole.trajectory), tolerance);
      EXPECT_EQ(resumed.summary.status, "completed");
      EXPECT_EQ(resumed.summary.n_steps, whole.summary.n_steps);
      EXPECT_EQ(resumed.summary.n_remeshes, whole.summary.n_remeshes);
      EXPECT_EQ(n_files(folder), 4) << "something is left over beside trajectory, summary, snapshots and flow";
    }

    std::vector<std::string> contents(const std::filesystem::path &folder)
    {
      std::vector<std::string> result;
      for (const char *file : {"trajectory.csv", "summary.json", "snapshots.h5"})
        result.push_back(content(folder / file));
      return result;
    }
  } // namespace

  TEST(Resume, AKilledRunContinuesToTheSameTrajectory)
  {
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt(scene, run, Moment::after_first_checkpoint);
    simulate(scene, run, {"--resume"});
    expect_the_uninterrupted_motion(run);
  }

  // The past of the flow, which has crossed a remeshing.
  TEST(Resume, AKilledRunWithInertiaContinuesToTheSameTrajectory)
  {
    const ShrunkScene     inertial = scene.with({"fluid.inertia=full", "fluid.viscosity_Pa_s=0.15"});
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt(inertial, run, Moment::after_first_checkpoint);
    simulate(inertial, run, {"--resume"});
    expect_the_uninterrupted_motion(run, inertial);
  }

  // Its first checkpoint, before any step, and the next, among the steps whose works are integrated along the way.
  TEST(Resume, AStartUnderLoadKeepsItsWorks)
  {
    const ShrunkScene across = scene.with({"head.angle_rad=1.5707963267948966"});
    const double      whole  = simulate(across).summary.power_imbalance.value();
    for (const int n_checkpoints : {1, 2})
    {
      const TemporaryFolder folder;
      const auto            run = folder.path / "run";
      interrupt_after(n_checkpoints, across, run);
      simulate(across, run, {"--resume"});
      EXPECT_NEAR(read_motion(run).summary.power_imbalance.value(), whole, 1e-7);
    }
  }

  // In space the attitude is a quaternion, and all of a row has to come back: positions along z, torques.
  TEST(Resume, AKilledRunOutOfThePlaneContinuesToTheSameTrajectory)
  {
    const ShrunkScene     sphere{"rotating-sphere-3d", {"variant=quick", "time.periods=0.4", "field.bx_T=3e-3"}};
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt_after(2, sphere, run);
    ASSERT_FALSE(std::filesystem::exists(run / "trajectory.csv"));
    simulate(sphere, run, {"--resume"});
    const Trajectory whole = simulate(sphere).trajectory, resumed = read_motion(run).trajectory;
    ASSERT_EQ(resumed.size(), whole.size());
    EXPECT_LT(whole.back().head_qw, std::cos(M_PI / 6)); // it does turn, by more than 60 degrees
    EXPECT_NE(whole.back().head_qx, 0.);                 // and out of the plane
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
      const std::vector<double> a = numbers_of(resumed[i]), b = numbers_of(whole[i]);
      for (std::size_t k = 0; k < a.size(); ++k)
        EXPECT_NEAR(a[k], b[k], tolerance * std::max(std::abs(b[k]), 1e-12));
    }
  }

  // The tail in space, the flow's past, and a mesh that was made on the way.
  TEST(Resume, AKilledSwimmerInSpaceContinuesToTheSameTrajectory)
  {
    const ShrunkScene swimmer =
        coarse_swimmer_in_space(0.2).with({"fluid.inertia=full", "numerics.remesh_every_steps=3"});
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt_after(1, swimmer, run);
    ASSERT_FALSE(std::filesystem::exists(run / "trajectory.csv"));
    simulate(swimmer, run, {"--resume"});
    expect_the_uninterrupted_motion(run, swimmer);
  }

  TEST(Resume, ARunThatIsKilledTwiceContinuesToTheSameTrajectory)
  {
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt(scene, run, Moment::after_first_checkpoint);
    {
      ChildProcess again(tool(simulate_arguments(scene, run, {"--resume"})));
      const auto   checkpoint_time = [&] {
        std::error_code ignored; // none is left when the run is complete
        return std::filesystem::last_write_time(run / "checkpoint.h5", ignored);
      };
      ASSERT_TRUE(again.wait_until([&, first = checkpoint_time()] { return checkpoint_time() != first; }));
      ASSERT_TRUE(again.kill());
    }
    simulate(scene, run, {"--resume"});
    expect_the_uninterrupted_motion(run);
  }

  TEST(Resume, ARunThatIsKilledBeforeItsFirstCheckpointStartsAfresh)
  {
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt(scene, run, Moment::before_first_checkpoint);
    simulate(scene, run, {"--resume"});
    expect_the_uninterrupted_motion(run);
  }

  TEST(Resume, ACompleteRunIsSaidToBeCompleteAndLeftAsItIs)
  {
    const TemporaryFolder folder;
    const auto            short_run = coarse_swimmer(20, 0.2);
    simulate(short_run, folder.path);
    const auto before = contents(folder.path);
    expect_in(simulate(short_run, folder.path, {"--resume"}).out, "complete");
    EXPECT_EQ(contents(folder.path), before);
  }

  // As after a disk that was full, or a kill, while the results were written.
  TEST(Resume, WritesTheResultsThatAreMissing)
  {
    const TemporaryFolder folder;
    const auto            short_run = coarse_swimmer(20, 0.2);
    simulate(short_run, folder.path);
    std::filesystem::remove(folder.path / "summary.json");
    std::filesystem::remove(folder.path / "snapshots.h5");
    simulate(short_run, folder.path, {"--resume"});
    EXPECT_EQ(n_files(folder.path), 4);
  }

  TEST(Resume, OfACompleteRunWithOtherSettingsIsRefused)
  {
    const TemporaryFolder folder;
    const auto            short_run = coarse_swimmer(20, 0.2);
    simulate(short_run, folder.path);
    const auto before = contents(folder.path);
    const auto other  = short_run.with({"tail.young_modulus_Pa=9e4"});
    expect_failure(run_tool(simulate_arguments(other, folder.path, {"--resume"})), 2, {"another scene"});
    EXPECT_EQ(contents(folder.path), before);
  }

  TEST(Resume, WithOtherSettingsOrAnotherSceneIsRefused)
  {
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt(scene, run, Moment::after_first_checkpoint);
    const auto  checkpoint = content(run / "checkpoint.h5");
    ShrunkScene other      = scene;
    other.name             = "reference-2d-paper";
    for (const auto &wrong : {scene.with({"tail.young_modulus_Pa=9e4"}), other})
      expect_failure(run_tool(simulate_arguments(wrong, run, {"--resume"})), 2, {"checkpoint.h5", "--force"});
    EXPECT_EQ(content(run / "checkpoint.h5"), checkpoint);
  }

  TEST(Resume, AnInterruptedRunIsNotOverwrittenByANewOneWithoutForce)
  {
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt(scene, run, Moment::after_first_checkpoint);
    expect_failure(run_tool(simulate_arguments(scene, run)), 2, {"--resume", "--force"});
  }

  // The files of the older run must not pass for those of the interrupted one.
  TEST(Resume, AfterForceAndAnEarlyKillDoesNotTakeTheOldResultsForNew)
  {
    const TemporaryFolder folder;
    const auto            old_run = coarse_swimmer(20, 0.2), new_run = coarse_swimmer(40, 1.);
    simulate(old_run, folder.path);
    {
      ChildProcess run(tool(simulate_arguments(new_run, folder.path, {"--force"})));
      ASSERT_FALSE(run.wait_for_file(folder.path / "checkpoint.h5") && !run.kill());
    }
    std::filesystem::remove(folder.path / "checkpoint.h5"); // as if it had been killed earlier
    const Outcome outcome = run_tool(simulate_arguments(new_run, folder.path, {"--resume"}));
    if (outcome.exit_code == 0)
      EXPECT_EQ(read_motion(folder.path).trajectory.size(), 41);
    else
      EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  }

  TEST(Resume, ADamagedCheckpointIsRefused)
  {
    const TemporaryFolder folder;
    folder.write("checkpoint.h5", "not a checkpoint");
    expect_failure(run_tool(simulate_arguments(scene, folder.path, {"--resume"})), 2, {"checkpoint.h5", "--force"});
  }

  TEST(Resume, ACheckpointThatIsDamagedAnywhereIsRefused)
  {
    const TemporaryFolder folder;
    const auto            run = folder.path / "run";
    interrupt(scene, run, Moment::after_first_checkpoint);
    const std::string        whole = content(run / "checkpoint.h5");
    const std::size_t        n     = whole.size();
    std::vector<std::string> damaged{"", std::string(n, '\0'), whole + "x", whole + whole};
    for (const std::size_t at : {std::size_t(0), std::size_t(9), std::size_t(40), n / 3, n / 2, n - 100, n - 40, n - 1})
    {
      damaged.push_back(whole);
      damaged.back()[at] ^= 4;
      damaged.push_back(whole.substr(0, at));
    }
    for (const std::size_t at : {std::size_t(512), n / 2}) // a block that was never written, or twice
    {
      damaged.push_back(std::string(whole).replace(at, 512, std::string(512, '\0')));
      damaged.push_back(std::string(whole).insert(at, whole.substr(at, 512)));
    }
    for (const std::string &text : damaged)
    {
      std::ofstream(run / "checkpoint.h5", std::ios::binary) << text;
      expect_failure(run_tool(simulate_arguments(scene, run, {"--resume"})), 2, {"checkpoint.h5", "--force"});
      EXPECT_EQ(content(run / "checkpoint.h5"), text);
    }
  }
} // namespace swimtwin
