#include <reports/run/draw_run.h>

#include <reports/page/gnuplot.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/environment_variable.h>
#include <tests/reports/synthetic_run.h>

#include <algorithm>
#include <cstdlib>

namespace swimtwin
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Scripts of the pictures, without the shared style: what was chosen, drawn or not.
    std::vector<std::string> scripts(const fs::path &folder)
    {
      std::vector<std::string> names;
      for (const fs::directory_entry &entry : fs::directory_iterator(folder / "pictures"))
        if (entry.path().extension() == ".gp" && entry.path().stem() != "style")
          names.push_back(entry.path().stem());
      std::sort(names.begin(), names.end());
      return names;
    }

    using Names = std::vector<std::string>;

    class DrawRun : public ::testing::Test
    {
    protected:
      std::vector<fs::path> draw()
      {
        return draw_run(folder.path, scene, trajectory, summary, snapshots, flows, warning);
      }
      void SetUp() override { summarize_motion(trajectory, scene.field.period_s(), 0., summary); }

      const TemporaryFolder      folder;
      Scene                      scene      = synthetic_scene();
      Trajectory                 trajectory = synthetic_trajectory(scene.field.period_s(), 200, 100, 0.002);
      RunSummary                 summary;
      std::optional<SnapshotSet> snapshots = synthetic_snapshots(trajectory, 2);
      std::vector<PlaneFlow>     flows;
      std::string                warning = "left from before";
    };

    /// No program is found while it lives.
    struct EmptyPath
    {
      const EnvironmentVariable path{"PATH", "/nowhere"};
    };
  } // namespace

  TEST_F(DrawRun, SwimmerHasFivePictures)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const std::vector<fs::path> drawn = draw();
    EXPECT_EQ(warning, "");
    ASSERT_EQ(drawn.size(), 5u);
    for (const fs::path &png : drawn)
      EXPECT_EQ(content(png).substr(0, 4), "\x89PNG") << png;
    EXPECT_EQ(n_files(folder.path / "pictures"), 5u * 3u + 1u);
  }

  TEST_F(DrawRun, AFlowIsShownWhereItMoves)
  {
    const EmptyPath no_gnuplot;
    PlaneFlow       flow;
    flow.time_s       = trajectory.back().time_s;
    flow.x_m          = {0., 1e-3};
    flow.y_m          = {0., 1e-3, 2e-3};
    flow.velocity_m_s = Eigen::MatrixXd::Zero(6, 2);
    flow.part         = Eigen::VectorXi::Constant(6, static_cast<int>(SampledPart::fluid));
    flows             = {flow};
    draw();
    EXPECT_FALSE(fs::exists(folder.path / "pictures/flow_in_plane.gp"));
    flows.front().velocity_m_s(4, 1) = 2e-3;
    draw();
    const std::string script = content(folder.path / "pictures/flow_in_plane.gp");
    expect_in(script, "speed_max = 2");
    expect_in(script, "up to 2 mm/s");
  }

  TEST_F(DrawRun, WithoutGnuplotTheScriptsStayAndOneSentenceTellsTheRemedy)
  {
    const EmptyPath no_programs;
    EXPECT_TRUE(draw().empty());
    expect_in(warning, "gnuplot is not installed");
    expect_in(warning, "apt-get install gnuplot-nox");
    EXPECT_EQ(scripts(folder.path), (Names{"angles", "power_balance", "shapes", "stroke_loop", "trajectory"}));
  }

  TEST_F(DrawRun, TitlesTellTheFindings)
  {
    const EmptyPath no_programs;
    draw();
    expect_in(content(folder.path / "pictures/trajectory.gp"), "+0.17 mm (+0.021 body lengths)");
    expect_in(content(folder.path / "pictures/power_balance.gp"), "imbalance −0.2 % of the magnetic work");
    expect_in(content(folder.path / "pictures/stroke_loop.gp"), "degrees², counter-clockwise");
  }

  TEST_F(DrawRun, RigidBodyHasNoTailToShow)
  {
    const EmptyPath no_programs;
    draw();
    scene.tail.reset();
    snapshots.reset();
    draw();
    EXPECT_EQ(scripts(folder.path), (Names{"angles", "power_balance", "shapes", "trajectory"})); // no stale loop
    expect_in(content(folder.path / "pictures/angles.gp"), "has_tail = 0");
  }

  TEST_F(DrawRun, FixedHeadHasNoPath)
  {
    const EmptyPath no_programs;
    scene.head.motion = HeadMotion::fixed;
    draw();
    EXPECT_EQ(scripts(folder.path), (Names{"angles", "power_balance", "shapes"}));
  }

  TEST_F(DrawRun, WithoutAPeriodTimeIsInSecondsAndThereIsNoLoop)
  {
    const EmptyPath no_programs;
    scene.field = FieldProgram::constant(0., 5e-3);
    draw();
    EXPECT_EQ(scripts(folder.path), (Names{"angles", "power_balance", "shapes", "trajectory"}));
    expect_in(content(folder.path / "pictures/angles.gp"), "time_label = 'time (s)'");
  }

  TEST_F(DrawRun, EveryKindOfRunCanBeDrawn)
  {
    if (find_gnuplot_fault())
      GTEST_SKIP() << "gnuplot is not installed";
    const auto expect_drawn = [&](const std::size_t n) {
      EXPECT_EQ(draw().size(), n);
      EXPECT_EQ(warning, "");
    };
    trajectory.resize(30); // failed in the first period
    summary = RunSummary();
    expect_drawn(4);
    for (TrajectoryRow &row : trajectory) // at rest
    {
      row          = TrajectoryRow{.time_s = row.time_s};
      row.head_x_m = 1e-3;
    }
    expect_drawn(3);
    scene.tail.reset();
    scene.head.motion = HeadMotion::fixed;
    expect_drawn(0);
    trajectory.resize(1);
    expect_drawn(0);
  }

  TEST_F(DrawRun, AFolderThatCannotBeMadeIsAWarning)
  {
    folder.write("pictures", "a file in the way");
    EXPECT_TRUE(draw().empty());
    expect_in(warning, "no pictures were drawn");
  }
} // namespace swimtwin
