#include <control/goal/tracking_goal.h>

#include <datasets/system/error.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/places.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace swimtwin
{
  namespace
  {
    class TrackingGoals : public ::testing::Test
    {
    protected:
      static ReducedModel shipped(const std::string &name)
      {
        return read_reduced_model(std::string(places::models) + "/" + name + ".h5");
      }

      std::filesystem::path file(const std::string &text) const
      {
        std::ofstream(folder.path / "goal.toml") << text;
        return folder.path / "goal.toml";
      }
      TrackingGoal read(const std::string &text) const { return read_tracking_goal(file(text), open); }

      void expect_refusal(const std::string &text, const std::string &part, const ReducedModel &model) const
      {
        try
        {
          read_tracking_goal(file(text), model);
          ADD_FAILURE() << "accepted: " << text;
        }
        catch (const InputError &error)
        {
          EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
      }
      void expect_refusal(const std::string &text, const std::string &part) const { expect_refusal(text, part, open); }

      const TemporaryFolder folder;
      const ReducedModel    open   = shipped("open-2d");
      const std::string     circle = "kind = \"path\"\n[path]\nshape = \"circle\"\nsize_m = 8e-3\n";
    };
  } // namespace

  TEST_F(TrackingGoals, OfALaboratoryStateNoSwimmerAndNoImaginedCamera)
  {
    const std::string loop = "kind = \"closed-loop\"\n[path]\nshape = \"circle\"\nsize_m = 8e-3\n[loop]\n"
                             "plant = \"external\"\n";
    EXPECT_EQ(read(loop).plant, PlantKind::external);
    EXPECT_NEAR(read(loop).limits.magnitude_T, 5e-3 * std::sqrt(2.), 1e-12);
    EXPECT_NEAR(read(loop + "[limits]\nmagnitude_T = 7.08e-3\n").limits.magnitude_T, 5e-3 * std::sqrt(2.), 1e-12);
    expect_refusal(loop + "delay_s = 0.1\n", "of an imagined plant");
    expect_refusal(loop + "position_noise = 0.01\n", "of an imagined plant");
    expect_refusal(loop + "[plant]\nviscosity_Pa_s = 1.0\n", "has no [plant]");
    expect_refusal(loop + "[swimmer]\nviscosity_Pa_s = 1.0\n", "has no [swimmer]");
    expect_refusal(circle + "[loop]\nplant = \"external\"\n", "change kind");
  }

  TEST_F(TrackingGoals, TakeFromTheModelWhatTheyLeaveOut)
  {
    const TrackingGoal goal = read(circle);
    EXPECT_EQ(goal.kind, TrackingKind::path);
    EXPECT_NEAR(goal.carrier.frequency_Hz, 0.9, 1e-12);
    EXPECT_EQ(goal.carrier.parameters, Eigen::Vector2d(5e-3, 5e-3));
    EXPECT_EQ(goal.believed.young_modulus_Pa, 8e4);
    EXPECT_EQ(goal.true_parameters.young_modulus_Pa, 8e4);
  }

  TEST_F(TrackingGoals, ReadWaypointsPlantAndLoop)
  {
    const TrackingGoal goal = read("kind = \"closed-loop\"\n[path]\nshape = \"waypoints\"\nwaypoint_1_m = [0.02, 0.0]\n"
                                   "waypoint_2_m = [0.02, 0.03]\n[plant]\nviscosity_Pa_s = 1.7\n[loop]\nseed = 4\n"
                                   "position_noise = 0.01\nplant = \"full-order\"\n");
    EXPECT_NEAR(goal.path.length_m(), 0.05, 1e-15);
    EXPECT_EQ(goal.true_parameters.viscosity_Pa_s, 1.7);
    EXPECT_EQ(goal.believed.viscosity_Pa_s, 1.52);
    EXPECT_EQ(goal.options.seed, 4u);
    EXPECT_EQ(goal.plant, PlantKind::full_order);
  }

  TEST_F(TrackingGoals, AreToldFromTargets)
  {
    EXPECT_FALSE(is_target_goal(file(circle)));
    EXPECT_FALSE(is_target_goal(file("[objective]\nmean_speed = 1\n")));
    EXPECT_TRUE(is_target_goal(file("kind = \"target\"\n")));
  }

  TEST_F(TrackingGoals, RefuseWhatCannotBe)
  {
    expect_refusal("kind = \"path\"\n[path]\nshape = \"circle\"\n", "size_m");
    expect_refusal("kind = \"path\"\n[path]\nshape = \"spiral\"\nsize_m = 1\n", "spiral");
    expect_refusal("kind = \"path\"\n[path]\nshape = \"waypoints\"\n", "waypoint_1_m");
    expect_refusal(circle + "[carrier]\nbx_T = 6e-3\nby_T = 6e-3\n", "above largest_field_T = 0.007071");
    expect_refusal(circle + "[loop]\nseeds = 3\n", "seeds");
    expect_refusal("kind = \"path\"\n[path]\nshape = \"circle\"\nsize_m = 1e-3\n", "than the swimmer can follow");
  }

  TEST_F(TrackingGoals, LeadAPointBehindTheHeadOnASmoothPath)
  {
    const TrackingGoal goal = read(circle + "point_behind = 0.4\n");
    const double       L    = ReducedSwimmer(open).length_m();
    ASSERT_TRUE(goal.options.point);
    EXPECT_NEAR(goal.options.point->behind_m, 0.4 * L, 1e-15);
    EXPECT_NEAR(goal.path.length_m() / goal.options.point->path.length_m(), std::hypot(1., 0.4 * L / 8e-3), 1e-4);
    expect_refusal("kind = \"path\"\n[path]\nshape = \"square\"\nsize_m = 2e-2\npoint_behind = 0.4\n",
                   "around a corner");
  }

  TEST_F(TrackingGoals, TurnNoFasterThanTheSlewRateAllows)
  {
    // At 0.9 Hz the carrier itself changes by 2 pi 0.9 Hz 5 mT = 28.3 mT/s.
    expect_refusal(circle + "[limits]\nslew_rate_T_s = 0.028\n", "changes by 0.02827 T/s itself");
    EXPECT_EQ(read(circle + "[limits]\nslew_rate_T_s = 1.0\n").options.follower.max_turn_rad, 0.5);
    const TrackingGoal goal = read(circle + "[limits]\nslew_rate_T_s = 0.029\n");
    EXPECT_GT(goal.options.follower.max_turn_rad, 0.);
    // The fastest turn of all, there and back, as the coils play it.
    SteeringPlan plan{goal.carrier, 0.5, Eigen::VectorXd::Zero(40)};
    for (Eigen::Index k = 1; k < 40; ++k)
      plan.angles_rad[k] = plan.angles_rad[k - 1] + (k % 20 < 10 ? 1. : -1.) * goal.options.follower.max_turn_rad;
    const double step_s = 1. / goal.sample_rate_Hz, f = goal.carrier.frequency_Hz;
    double       largest = 0.;
    for (double time = 0.; time * f < 18.; time += step_s)
      largest = std::max(largest, (plan.field_T((time + step_s) * f) - plan.field_T(time * f)).norm() / step_s);
    EXPECT_LE(largest, 0.029);
    EXPECT_GE(largest, 0.0285);
  }

  TEST_F(TrackingGoals, RefuseCoilsThatCannotTurnTheCarrier)
  {
    const std::string coils = "[limits]\ncoil_1_A_T = [300.0, 0.0]\ncoil_2_A_T = [0.0, 400.0]\n";
    EXPECT_NO_THROW(read(circle + coils + "coil_current_A = 2.9\n"));
    expect_refusal(circle + coils + "coil_current_A = 2.8\n", "the 2.828 A that coil 2 needs");
    expect_refusal(circle + "[limits]\nbx_T = 6e-3\n", "largest field of 0.007071 T");
  }

  TEST_F(TrackingGoals, RefusePathsThroughWalls)
  {
    expect_refusal("kind = \"path\"\n[path]\nshape = \"line\"\nsize_m = 0.05\n", "of a wall, or through it",
                   shipped("reference-2d"));
  }
} // namespace swimtwin
