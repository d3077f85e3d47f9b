#include <app/frame/tool.h>
#include <datasets/run/run_summary_json.h>
#include <datasets/run/snapshot_set.h>
#include <datasets/run/trajectory.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <datasets/text/csv_table.h>
#include <tests/app/tool_in_process.h>
#include <tests/control/small_model.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/rom/example_model.h>

namespace swimtwin
{
  namespace
  {
    class ReconstructVerb : public ::testing::Test
    {
    protected:
      ReconstructVerb() { write_reduced_model(model, example_model({.magnetic_tail = false}), Provenance{}); }

      Outcome reconstruct(const std::vector<std::string> &options) const
      {
        std::vector<std::string> arguments = {"reconstruct", model, "--output", results};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_in_process(arguments, {{"reconstruct", add_reconstruct}});
      }

      void expect_refused(const Outcome &outcome, const std::string &part) const
      {
        EXPECT_EQ(outcome.code, 2);
        expect_in(outcome.errors, part);
        EXPECT_FALSE(std::filesystem::exists(results));
      }

      const TemporaryFolder folder;
      const std::string     model = folder.path / "model.h5", results = folder.path / "results";
    };
  } // namespace

  TEST_F(ReconstructVerb, WritesMotionAndShapesAtTheSameInstants)
  {
    const Outcome outcome =
        reconstruct({"--set", "field.frequency_Hz=0.5", "--set", "time.periods=2", "--instants", "8"});
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    const Trajectory  motion = read_trajectory_csv(folder.path / "results/trajectory.csv");
    const SnapshotSet shapes = read_snapshots(folder.path / "results/snapshots.h5");
    ASSERT_EQ(motion.size(), 17u);
    ASSERT_EQ(shapes.time_s.size(), 17u);
    EXPECT_NEAR(motion.back().time_s, 4., 1e-12);
    for (std::size_t i = 0; i < motion.size(); ++i)
      EXPECT_EQ(shapes.pose(static_cast<Eigen::Index>(i), 2), motion[i].head_angle_rad);
    const RunSummary summary = read_run_summary_json(folder.path / "results/summary.json").summary;
    EXPECT_EQ(summary.status, "completed");
    EXPECT_EQ(summary.displacement_per_period_m.size(), 2u);
  }

  TEST_F(ReconstructVerb, SaysWhenTheRunLeavesTheTrainedRange)
  {
    expect_in(reconstruct({"--set", "tail.young_modulus_Pa=1e3", "--set", "time.periods=1"}).errors,
              "young_modulus_Pa = 1000 below 4e+04");
  }

  // One run is one row of a sweep, and what a run writes of its tail is shape, not velocity.
  TEST_F(ReconstructVerb, CarriesInertiaLikeASweep)
  {
    write_reduced_model(model, truncated(read_reduced_model(std::string(places::models) + "/reference-2d.h5"), 2),
                        Provenance{});
    const std::string swept = folder.path / "swept";
    ASSERT_EQ(run_in_process({"sweep", model, "--output", swept, "--inertia", "full"}, {{"sweep", add_sweep}}).code, 0);
    const double expected =
        CsvTable::read(folder.path / "swept" / "displacement_frequency.csv").column("displacement_m").front();
    ASSERT_EQ(reconstruct({"--inertia", "full"}).code, 0);
    const RunSummary with = read_run_summary_json(folder.path / "results/summary.json").summary;
    EXPECT_NEAR(with.net_displacement_m.value(), expected, 1e-4 * std::abs(expected));
    EXPECT_EQ(with.inertia->kept.size(), 4u);
    const Eigen::MatrixXd bent = read_snapshots(folder.path / "results/snapshots.h5").tail_displacement_m;
    const Outcome         none = reconstruct({"--inertia", "none", "--force"});
    expect_in(none.errors, "the reduced swimmer neglects inertia");
    const RunSummary without = read_run_summary_json(folder.path / "results/summary.json").summary;
    EXPECT_TRUE(without.inertia->kept.empty());
    EXPECT_GT(std::abs(without.net_displacement_m.value() / expected - 1.), 0.01);
    const Eigen::MatrixXd bent_without = read_snapshots(folder.path / "results/snapshots.h5").tail_displacement_m;
    EXPECT_LT((bent - bent_without).norm(), 0.1 * bent_without.norm());
  }

  TEST_F(ReconstructVerb, RefusesWhatTheModelCannotRepeat)
  {
    expect_refused(reconstruct({"--set", "tail.length_m=9e-3"}), "changes what the reduced model was trained for");
    expect_refused(reconstruct({"--set", "time.periods=1.5"}), "whole number of periods");
  }

  TEST_F(ReconstructVerb, RefusesFlowWithoutTheFullOrderModel)
  {
    expect_refused(reconstruct({"--flow"}), "--flow needs the full-order model");
  }

  TEST_F(ReconstructVerb, KeepsResultsUnlessForced)
  {
    ASSERT_EQ(reconstruct({"--set", "time.periods=1"}).code, 0);
    expect_in(reconstruct({"--set", "time.periods=1"}).errors, "--force");
  }
} // namespace swimtwin
