#include <control/steering/target_search.h>

#include <control/steering/course_terms.h>
#include <rom/sensitivity/adjoint_check.h>
#include <rom/sweep/sweep.h>
#include <rom/swimmer/bspline_field.h>
#include <tests/places.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    class OpenSwimmer : public ::testing::Test
    {
    protected:
      const ReducedModel   model   = read_reduced_model(std::string(places::models) + "/open-2d.h5");
      const ReducedSwimmer swimmer = ReducedSwimmer(model);
      const double         L       = swimmer.length_m();
      RunRequest           request = sweep_options(parse_scene(model.scene_text, "open-2d.toml"), model).base;
      SwimmerState         start   = state_at_rest(swimmer);

      static std::vector<Parameter> parameters_of(const Drive &drive)
      {
        std::vector<Parameter> parameters = {{Quantity::frequency, 0}, {Quantity::initial_angle, 0}};
        for (int i = 0; i < drive.parameters.size(); ++i)
          parameters.push_back({Quantity::field, i});
        return parameters;
      }

      TargetWay reach(const Eigen::Vector2d &target_m, const TargetOptions &options = {}) const
      {
        return fastest_way(swimmer, request.parameters, request.drive, start, target_m, options);
      }
    };
  } // namespace

  TEST_F(OpenSwimmer, TermsOfACourseHaveTheirDerivatives)
  {
    request.n_periods        = 1;
    request.initial_state[2] = 0.1;
    request.drive            = spline_drive(request.drive, 12, false, 2);
    WeightedCourse course;
    course.add(2., std::make_shared<TargetTerm>(Eigen::Vector2d(-1e-3, 2e-3), 1e-3));
    course.add(
        0.5, std::make_shared<TimedPathTerm>(Path::line(L).placed(3.0, {1e-4, 0.}), TimedPathOptions{2e-4, 1e-3, 0.3}));
    course.add(3., std::make_shared<CopperLossTerm>(5e-3));
    AdjointIntegrator adjoint(swimmer, {.relative_tolerance = 1e-10, .max_step_periods = 0.025});
    EXPECT_LE(largest_error(check_adjoint(adjoint, request, course, parameters_of(request.drive))), 1e-5);
  }

  TEST_F(OpenSwimmer, HeadingAlongACircleHasItsDerivatives)
  {
    request.n_periods        = 3;
    request.initial_state[2] = 0.1;
    request.drive            = spline_drive(request.drive, 12, false, 2);
    // A turn by 1.2 rad: the direction at an instant is that of a circle's piece, which ends within the instants.
    const double        radius = 0.1 * L;
    const TimedPathTerm heading(Path::circle(radius).placed(3.0, {1e-4, 0.}), {0.4 * radius, 1e3, 0.3});
    AdjointIntegrator   adjoint(swimmer, {.relative_tolerance = 1e-10, .max_step_periods = 0.025 / 3.});
    EXPECT_LE(largest_error(check_adjoint(adjoint, request, heading, parameters_of(request.drive))), 1e-5);
  }

  TEST_F(OpenSwimmer, ReachesATargetAheadAsFastAsItsCarrierSwims)
  {
    const Eigen::Vector2d target = {-0.15 * L, 0.};
    const TargetWay       way    = reach(target);
    ASSERT_TRUE(way.minimum.converged()) << way.minimum.message; // the first-order conditions hold
    EXPECT_LE((way.end_m - target).norm(), 0.01001 * L);
    // The start from rest and the swing within a period give or take a period.
    EXPECT_NEAR(way.time_s, way.straight_time_s, 1. / way.plan.carrier.frequency_Hz);
  }

  TEST_F(OpenSwimmer, ATurnedTargetTurnsTheFieldAndKeepsTheTime)
  {
    const double          angle  = 2.;
    const Eigen::Vector2d target = {-0.12 * L, 0.06 * L};
    const TargetWay       way    = reach(target, {.periods = {13}});
    ASSERT_TRUE(way.found()) << way.minimum.message;
    EXPECT_LE((way.end_m - target).norm(), 0.01001 * L);
    // The plan played anew arrives where it said.
    MotionStore        store(swimmer, {.max_step_periods = 0.05 / way.n_periods});
    const StoredMotion again = store.run({request.parameters, window_of(way.plan, 0., way.n_periods), start, 1, 0});
    EXPECT_LE((again.end().head<2>() - target).norm(), 0.0101 * L);
    start[2] += angle;
    const TargetWay turned = reach(Eigen::Rotation2Dd(angle) * target, {.periods = {13}});
    ASSERT_TRUE(turned.found()) << turned.minimum.message;
    // Both searches end where the first-order residual is at most 1e-2: nearly the same time, by nearly the same field.
    EXPECT_NEAR(turned.time_s, way.time_s, 1e-2 * way.time_s);
    for (const double phase : {0., 3.3, 7.1, 12.9})
      EXPECT_NEAR(turned.plan.angle_rad(phase) - way.plan.angle_rad(phase), angle, 0.1);
  }

  TEST_F(OpenSwimmer, SaysWhichTargetItCannotReach)
  {
    const TargetWay way = reach({-0.15 * L, 0.}, {.periods = {4}});
    EXPECT_FALSE(way.found());
    EXPECT_NE(way.minimum.message.find("distance from the target"), std::string::npos) << way.minimum.message;
    EXPECT_FALSE(reach({-0.15 * L, 0.}, {.time_limit_s = 1.}).found());
  }
} // namespace swimtwin
