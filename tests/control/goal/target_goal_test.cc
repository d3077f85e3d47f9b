#include <control/goal/target_goal.h>

#include <control/field/steering_limits.h>
#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>

#include <gtest/gtest.h>

#include <fstream>

namespace swimtwin
{
  namespace
  {
    class TargetGoals : public ::testing::Test
    {
    protected:
      static ReducedModel shipped(const std::string &name)
      {
        return read_reduced_model(std::string(places::models) + "/" + name + ".h5");
      }

      TargetGoal read(const std::string &text, const ReducedModel &model) const
      {
        std::ofstream(folder.path / "goal.toml") << "kind = \"target\"\n" << text;
        return read_target_goal(folder.path / "goal.toml", model);
      }

      void expect_refusal(const std::string &text, const std::string &part, const ReducedModel &model) const
      {
        try
        {
          read(text, model);
          ADD_FAILURE() << "accepted: " << text;
        }
        catch (const InputError &error)
        {
          EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
      }

      const TemporaryFolder folder;
      const ReducedModel    open = shipped("open-2d"), box = shipped("reference-2d");
    };
  } // namespace

  TEST_F(TargetGoals, LieAheadAndToTheLeftOfTheSwimmer)
  {
    const TargetGoal goal = read("[target]\nposition_m = [4e-3, 1e-3]\ntime_limit_s = 1e3\n", open);
    EXPECT_LT((goal.target_m - Eigen::Vector2d(-4e-3, -1e-3)).norm(), 1e-15); // head first is -x
    EXPECT_EQ(goal.options.time_limit_s, 1e3);
    EXPECT_EQ(goal.options.frequency_Hz.high, open.range.frequency_Hz.high);
    EXPECT_GT(turn_towards(goal.target_m, goal.start), 0.);
  }

  TEST_F(TargetGoals, AreRefusedBeyondWalls)
  {
    expect_refusal("[target]\nposition_m = [0.03, 0.0]\n", "of a wall, or through it", box);
    expect_refusal("[target]\nposition_m = [0.0, 9.5e-3]\n", "of a wall, or through it", box);
    expect_refusal("[target]\nposition_m = [5e-3, 3e-3]\n", "knows one heading only", box);
    EXPECT_NO_THROW(read("[target]\nposition_m = [5e-3, 0.0]\n", box));
  }

  TEST_F(TargetGoals, AreRefusedTooNearAndTooFar)
  {
    expect_refusal("[target]\nposition_m = [5e-5, 0.0]\n", "already", open);
    expect_refusal("[target]\nposition_m = [5e-3, 0.0]\ntime_limit_s = 2.0\n", "time_limit_s = 2", open);
    for (const char *far : {"1e6", "1e300"})
      expect_refusal(std::string("[target]\nposition_m = [") + far + ", 0.0]\n", "at most 10000 are possible", open);
    expect_refusal("", "position_m is missing", open);
    expect_refusal("[target]\nposition_m = [5e-3, 0.0]\nspeed = 1.0\n", "speed", open);
    expect_refusal("[target]\nposition_m = [5e-3, 0.0]\nfrequency_low_Hz = 9.0\n", "leaves no frequency", open);
  }

  TEST_F(TargetGoals, SlewRateBoundsTheFrequency)
  {
    const std::string target = "[target]\nposition_m = [5e-3, 0.0]\n";
    const TargetGoal  goal   = read(target + "[limits]\nslew_rate_T_s = 0.05\n", open);
    const double slew = largest_slew_T_per_period(goal.carrier, goal.options.max_turn_rad / goal.options.knot_periods);
    EXPECT_NEAR(goal.options.frequency_Hz.high, 0.05 / slew, 1e-12);
    expect_refusal(target + "[limits]\nslew_rate_T_s = 1e-4\n", "of the turned carrier at the lowest frequency", open);
  }
} // namespace swimtwin
