// On the shipped swimmer without walls. Its body is 7.75 mm long.
#include <control/steering/closed_loop.h>

#include <datasets/scene/inertia_terms.h>
#include <datasets/system/error.h>
#include <rom/sweep/sweep.h>
#include <rom/swimmer/carried_inertia.h>
#include <tests/places.h>

#include <gtest/gtest.h>

#include <cstdio>

namespace swimtwin
{
  namespace
  {
    class ClosedLoopOfTheOpenSwimmer : public ::testing::Test
    {
    protected:
      const ReducedModel      model    = read_reduced_model(std::string(places::models) + "/open-2d.h5");
      const ReducedSwimmer    swimmer  = ReducedSwimmer(model);
      const double            L        = swimmer.length_m();
      const RunRequest        request  = sweep_options(parse_scene(model.scene_text, "open-2d.toml"), model).base;
      const SwimmerParameters believed = request.parameters;
      const Path              arc      = Path::circle(L).first(0.6 * L);

      /// Softer, weaker and in a thicker fluid than the model believes.
      SwimmerParameters wrong() const
      {
        return {0.9 * believed.young_modulus_Pa, 1.1 * believed.viscosity_Pa_s, 0.9 * believed.magnetization_A_m, 0.};
      }

      TrackResult lead(const SwimmerParameters &truth, const ClosedLoopOptions &options) const
      {
        ReducedPlant plant(swimmer, truth, state_at_rest(swimmer));
        return run_closed_loop(swimmer, believed, request.drive, arc, plant, options);
      }
    };
  } // namespace

  TEST_F(ClosedLoopOfTheOpenSwimmer, TurnsAboutAPointInsideItsBody)
  {
    const CarrierMotion motion = carrier_motion(swimmer, believed, request.drive);
    EXPECT_GT(motion.lever_m, 0.2 * L);
    EXPECT_LT(motion.lever_m, 0.6 * L);
    EXPECT_GT(motion.advance_m, 0.);
  }

  TEST_F(ClosedLoopOfTheOpenSwimmer, APlanStaysOnAnArcAndItsReplayRepeatsIt)
  {
    const TrackResult plan = follow_path(swimmer, believed, request.drive, arc, {.decisions_per_second = 5.});
    ASSERT_EQ(plan.status, TrackStatus::arrived) << plan.message;
    EXPECT_LE(plan.rms_distance_m, 0.005 * L);
    ReducedPlant      plant(swimmer, believed, state_at_rest(swimmer));
    const TrackResult replay = play_plan(swimmer, believed, plan, plant, {.decisions_per_second = 5.});
    EXPECT_NEAR(replay.rms_distance_m, plan.rms_distance_m, 1e-3 * L);
  }

  TEST(ClosedLoopWithInertia, APlanStaysOnItsLineAndItsReplayRepeatsIt)
  {
    const ReducedModel      model = read_reduced_model(std::string(places::models) + "/reference-2d.h5");
    const ReducedSwimmer    swimmer(model, inertial_densities(model, all_inertia)), light(model);
    const RunRequest        request = sweep_options(parse_scene(model.scene_text, "reference-2d.toml"), model).base;
    const ClosedLoopOptions options{.decisions_per_second = 5.};
    const Path              line = Path::line(0.08 * swimmer.length_m());
    const TrackResult       plan = follow_path(swimmer, request.parameters, request.drive, line, options);
    ASSERT_EQ(plan.status, TrackStatus::arrived) << plan.message;
    EXPECT_LE(plan.rms_distance_m, 0.005 * swimmer.length_m());
    ReducedPlant      plant(swimmer, request.parameters, state_at_rest(swimmer));
    const TrackResult replay = play_plan(swimmer, request.parameters, plan, plant, options);
    EXPECT_NEAR(replay.rms_distance_m, plan.rms_distance_m, 1e-3 * swimmer.length_m());
    const double without = carrier_motion(light, request.parameters, request.drive).advance_m;
    EXPECT_GT(std::abs(plan.advance_m / without - 1.), 2e-3);
  }

  TEST_F(ClosedLoopOfTheOpenSwimmer, StaysOnTheArcWithWrongParametersAndNoise)
  {
    const TrackResult result = lead(wrong(), {.position_noise = 0.01, .angle_noise_rad = 0.0175});
    ASSERT_EQ(result.status, TrackStatus::arrived) << result.message;
    std::printf("closed loop: %.2f %% of a body length (rms), decisions %.1f ms\n", 100. * result.rms_distance_m / L,
                1e3 * result.mean_decision_s);
    EXPECT_LE(result.rms_distance_m, 0.05 * L);
    EXPECT_LE(result.mean_decision_s, 0.05);
  }

  TEST_F(ClosedLoopOfTheOpenSwimmer, TurnsLessTowardsItsPathTheLessItsPlaceIsKnown)
  {
    const auto sharpest_turn = [&](const double position_sd_m) {
      PathFollower follower(swimmer, believed, Path::line(2. * L).placed(3.14159265358979, {0., 0.01 * L}), 1e-4);
      follower.believe(believed, position_sd_m);
      SteeringPlan plan;
      plan.carrier    = request.drive;
      plan.angles_rad = Eigen::VectorXd::Zero(20);
      MeanPosition record;
      for (int i = 0; i <= 40; ++i)
        record.add(0.05 * i, {0., 0.});
      EXPECT_TRUE(follower.improve(plan, 2., 2.05, state_at_rest(swimmer), record, 0.).completed);
      const Eigen::VectorXd &a = plan.angles_rad;
      return (a.tail(18) - 2. * a.segment(1, 18) + a.head(18)).cwiseAbs().maxCoeff();
    };
    EXPECT_GT(sharpest_turn(0.), 0.);
    EXPECT_LT(sharpest_turn(0.002 * L), sharpest_turn(0.));
    EXPECT_LT(sharpest_turn(0.01 * L), 0.5 * sharpest_turn(0.));
  }

  TEST_F(ClosedLoopOfTheOpenSwimmer, SeesAPoseAsLateAsItIsTold)
  {
    const ClosedLoopOptions options = {
        .decisions_per_second = 10., .deadline_s = 0., .delay_s = 0.3, .max_periods = 3.};
    const TrackResult result = lead(believed, options);
    ASSERT_GT(result.instants.size(), 10U);
    for (std::size_t i = 3; i < result.instants.size(); ++i) // three decisions ago
      EXPECT_EQ(result.instants[i].measured.position_m, result.instants[i - 3].pose.position_m);
  }

  TEST_F(ClosedLoopOfTheOpenSwimmer, TheLastPlanGoesOnWhenDecisionsAreLate)
  {
    const TrackResult result = lead(believed, {.decisions_per_second = 5., .deadline_s = 1e-9, .max_periods = 8.});
    EXPECT_EQ(result.n_missed, result.n_decisions);
    EXPECT_EQ(result.plan.angles_rad.norm(), 0.); // straight on
    EXPECT_EQ(result.status, TrackStatus::not_arrived);
    EXPECT_NE(result.message.find("when its time ended"), std::string::npos);
  }

  TEST_F(ClosedLoopOfTheOpenSwimmer, IsTheSameForTheSameSeed)
  {
    const ClosedLoopOptions options = {
        .decisions_per_second = 10., .deadline_s = 0., .position_noise = 0.01, .seed = 7, .max_periods = 3.};
    EXPECT_EQ(lead(wrong(), options).rms_distance_m, lead(wrong(), options).rms_distance_m);
  }

  TEST_F(ClosedLoopOfTheOpenSwimmer, MirroredPathsHaveMirroredPlans)
  {
    ClosedLoopOptions options           = {.decisions_per_second = 5., .max_periods = 3.};
    options.follower.relative_tolerance = 1e-9; // step sizes differ by round-off, and motions by this
    std::vector<Eigen::Vector2d> mirrored;
    for (const Eigen::Vector2d &point : arc.points_m())
      mirrored.emplace_back(point.x(), -point.y());
    // The mirrored swim is half a period late: the field swings to the other side first.
    Drive other = request.drive;
    other.parameters[1] *= -1.;
    const TrackResult left  = follow_path(swimmer, believed, request.drive, arc, options);
    const TrackResult right = follow_path(swimmer, believed, other, Path::through(mirrored), options);
    EXPECT_LE((left.plan.angles_rad + right.plan.angles_rad).lpNorm<Eigen::Infinity>(), 1e-5);
    EXPECT_GT(left.plan.angles_rad.lpNorm<Eigen::Infinity>(), 1e-2);
  }

  TEST_F(ClosedLoopOfTheOpenSwimmer, RefusesAPathThatItCannotFollow)
  {
    EXPECT_THROW(follow_path(swimmer, believed, request.drive, Path::circle(0.2 * L)), InputError);
  }
} // namespace swimtwin
