// Runs that are added near the worst of those held out.
#include <rom/training/added_runs.h>

#include <datasets/reduced/held_out_error.h>
#include <tests/datasets/temporary_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    const TrainedRange range{{1e5, 8e5}, {.5, 2.}, {4e4, 8e4}, {.2, 3.}, {4e-3, 4e-3}, {6e-3, 6e-3}};

    HeldOutRun held_out(const double young_modulus_Pa, const double frequency_Hz, const double error)
    {
      HeldOutRun run;
      run.young_modulus_Pa       = young_modulus_Pa;
      run.viscosity_Pa_s         = 1.;
      run.magnetization_A_m      = 6e4;
      run.frequency_Hz           = frequency_Hz;
      run.bx_T                   = 4e-3;
      run.by_T                   = 6e-3;
      run.displacement_m         = 1e-4;
      run.reduced_displacement_m = 1e-4 * (1. + error);
      return run;
    }

    RunGroups groups(const RunParameters &p)
    {
      return run_groups({p.young_modulus_Pa, p.viscosity_Pa_s, p.magnetization_A_m, p.frequency_Hz, p.bx_T, p.by_T});
    }
  } // namespace

  TEST(AddedRuns, LieNearTheWorstButAreOtherMotions)
  {
    TrainingRecord record;
    record.held_out_runs = {held_out(2e5, .3, .001), held_out(6e5, 2., -.04), held_out(1.5e5, 1., .02),
                            held_out(4e5, .5, .005)};
    const auto added     = runs_near_the_worst(record, range, 2, {});
    ASSERT_EQ(added.size(), 2u);
    EXPECT_NE(added[0].number, added[1].number);
    for (std::size_t i = 0; i < 2; ++i)
    {
      const RunGroups own = groups(added[i].parameters), worst = run_groups(record.held_out_runs[i + 1]);
      EXPECT_LT(std::abs(own.elastic - worst.elastic), std::log(2.)) << i;
      EXPECT_LT(std::abs(own.magnetic - worst.magnetic), std::log(2.)) << i;
      for (const auto &run : record.held_out_runs)
      {
        const RunGroups g = run_groups(run);
        EXPECT_GT(std::hypot(own.elastic - g.elastic, own.magnetic - g.magnetic), .05) << i;
      }
      EXPECT_GE(added[i].parameters.young_modulus_Pa, range.young_modulus_Pa.low);
      EXPECT_LE(added[i].parameters.frequency_Hz, range.frequency_Hz.high);
    }
  }

  TEST(AddedRuns, AreNotTakenTwice)
  {
    TrainingRecord record;
    record.held_out_runs = {held_out(6e5, 2., .04)};
    const auto first     = runs_near_the_worst(record, range, 2, {});
    ASSERT_EQ(first.size(), 1u);
    const auto second = runs_near_the_worst(record, range, 2, {first[0].number});
    ASSERT_EQ(second.size(), 1u);
    EXPECT_NE(first[0].number, second[0].number);
    EXPECT_EQ(runs_near_the_worst(record, range, 2, {})[0].number, first[0].number); // the same when it is resumed
  }

  TEST(AddedRuns, AreFoundInTheFolderOfTheirTraining)
  {
    const TemporaryFolder folder;
    for (const char *run : {"run-01", "run-2003", "run-2001", "run-2002"})
    {
      std::filesystem::create_directories(folder.path / run);
      for (const char *file : {"summary.json", "snapshots.h5"})
        if (std::string(run) + file != "run-2002summary.json") // interrupted
          folder.write(std::string(run) + "/" + file, "");
    }
    const auto found = added_run_folders(folder.path);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].filename(), "run-2001");
    EXPECT_EQ(found[1].filename(), "run-2003");
    EXPECT_TRUE(added_run_folders(folder.path / "none").empty());
  }

  TEST(AddedRuns, AreNoneWithoutHeldOutRuns)
  {
    EXPECT_TRUE(runs_near_the_worst({}, range, 2, {}).empty());
  }
} // namespace swimtwin
