#include <control/course_terms.h>
#include <control/target_search.h>
#include <rom/adjoint_check.h>
#include <rom/bspline_field.h>
#include <rom/sweep.h>

#include <gtest/gtest.h>

#include <cstdio>

namespace swimtwin
{
  namespace
  {
    class OpenSwimmer : public ::testing::Test
    {
    protected:
      const ReducedModel   model = read_reduced_model(std::string(SWIMTWIN_SOURCE_DIR) + "/datasets/models/open-2d.h5");
      const ReducedSwimmer swimmer = ReducedSwimmer(model);
      const double         L       = swimmer.length_m();
      RunRequest           request = sweep_options(parse_scene(model.scene_text, "open-2d.toml"), model).base;
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
    std::vector<Parameter> parameters = {{Quantity::frequency, 0}, {Quantity::initial_angle, 0}};
    for (int i = 0; i < request.drive.parameters.size(); ++i)
      parameters.push_back({Quantity::field, i});
    AdjointIntegrator adjoint(swimmer, {.relative_tolerance = 1e-10, .max_step_periods = 0.025});
    EXPECT_LE(largest_error(check_adjoint(adjoint, request, course, parameters)), 1e-5);
  }

  TEST_F(OpenSwimmer, ReachesATargetAsideFasterThanTheCarrierItself)
  {
    const SwimmerState    start  = state_at_rest(swimmer);
    const Eigen::Vector2d target = {-0.2 * L, 0.1 * L};
    const TargetWay way = fastest_way(swimmer, request.parameters, request.drive, start, target, {.periods = {10, 13}});
    ASSERT_TRUE(way.found()) << way.minimum.message;
    EXPECT_LE((way.end_m - target).norm(), 0.0101 * L);
    std::printf("target: %s after %.2f s in %d periods, %d evaluations\n", to_string(way.minimum.status).c_str(),
                way.time_s, way.n_periods, way.minimum.n_evaluations);
    // The plan played anew arrives where it said.
    MotionStore        store(swimmer, {.max_step_periods = 0.05 / way.n_periods});
    const StoredMotion again = store.run({request.parameters, window_of(way.plan, 0., way.n_periods), start, 1, 0});
    EXPECT_LE((again.end().head<2>() - target).norm(), 0.0102 * L);
  }
} // namespace swimtwin
