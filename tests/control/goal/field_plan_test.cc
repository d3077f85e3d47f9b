#include <control/goal/field_plan.h>
#include <control/goal/measured_field.h>
#include <control/stroke/robust_search.h>
#include <control/stroke/settled_start.h>
#include <datasets/system/error.h>
#include <tests/control/small_model.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    class Plans : public ::testing::Test
    {
    protected:
      Plans()
      {
        goal.weights                          = {{StrokeTerm::mean_speed, 1.}};
        goal.swimmer                          = request.parameters;
        goal.n_harmonics                      = 2;
        goal.family                           = FieldFamily::symmetric;
        goal.field.magnitude_T                = 7e-3;
        goal.frequency_Hz                     = {0.2, 1.5};
        options.n_starts                      = 0;
        options.search.search.max_evaluations = 40;
        options.search.stroke.n_samples       = 16;
        options.gradient_free_budget          = 0.;
      }

      PlanResult plan() const { return plan_field(model, goal, request.drive, options); }

      const ReducedModel model   = small_model();
      const RunRequest   request = small_request(model);
      SwimmingGoal       goal;
      FieldPlanOptions   options;
    };
  } // namespace

  TEST_F(Plans, BeatTheTunedSinusoidWithinTheSameLimits)
  {
    const PlanResult    result  = plan();
    const PlannedField &tuned   = *result.find(tuned_field_name);
    const PlannedField &optimal = *result.find(optimal_field_name);
    EXPECT_GE(tuned.mean_speed_m_s, result.find(reference_field_name)->mean_speed_m_s);
    EXPECT_GE(optimal.mean_speed_m_s, tuned.mean_speed_m_s * (1. - 1e-5));
    constexpr double allowed = 1e-5;
    for (const PlannedField *field : {&tuned, &optimal})
    {
      EXPECT_LT(field->field_excess, allowed);
      EXPECT_LT(field->motion_excess, 0.02);
      EXPECT_LE(field->largest_field_T, 7e-3 * (1. + allowed));
      EXPECT_LT(field->multipliers.front(), 0.8 * (1. + 1e-4));
      EXPECT_LE(field->kkt_residual, 1e-2) << field->name << ": " << field->message;
    }
    EXPECT_EQ(result.status, optimal.status);
  }

  TEST_F(Plans, RepeatToTheLastDigit)
  {
    options.n_starts                      = 2;
    options.search.search.max_evaluations = 10;
    options.search.n_threads              = 1;
    const PlanResult one                  = plan();
    options.search.n_threads              = 3;
    const PlanResult three                = plan();
    EXPECT_EQ(one.find(optimal_field_name)->bx_T, three.find(optimal_field_name)->bx_T);
    EXPECT_EQ(one.find(optimal_field_name)->mean_speed_m_s, three.find(optimal_field_name)->mean_speed_m_s);
  }

  TEST_F(Plans, NameTheLimitThatNoFieldMeets)
  {
    goal.motion.largest_multiplier        = 1e-30;
    options.search.search.max_evaluations = 6;
    const PlanResult result               = plan();
    EXPECT_EQ(result.status, "infeasible");
    EXPECT_NE(result.message.find("heading held: Floquet multiplier"), std::string::npos) << result.message;
  }

  TEST_F(Plans, SayThatTheSearchWithoutGradientsHasSpentItsPeriods)
  {
    options.gradient_free_budget          = 0.5;
    options.search.search.max_evaluations = 10;
    const PlanResult    result            = plan();
    const PlannedField &without           = *result.find(gradient_free_field_name);
    EXPECT_EQ(without.status, "budget exhausted") << without.message;
    EXPECT_EQ(without.message, "the budget of periods is spent");
  }

  TEST_F(Plans, NameTheTrustedRegionThatNoFieldKeepsTo)
  {
    goal.motion.shape_radius              = 1e-6;
    goal.motion.largest_multiplier        = FieldLimits::none;
    goal.field.component_T                = {7e-3, 7e-3};
    options.search.search.max_evaluations = 3;
    const PlanResult result               = plan();
    EXPECT_EQ(result.status, "infeasible");
    EXPECT_NE(result.message.find("trusted shape"), std::string::npos) << result.message;
  }

  TEST_F(Plans, SayThatTheSwimmerIsNoneThatTheModelWasTrainedFor)
  {
    options.search.search.max_evaluations = 3;
    const auto says_so                    = [this] {
      const auto warnings = plan().warnings;
      return std::any_of(warnings.begin(), warnings.end(), [](const std::string &warning) {
        return warning.find("swimmer and frequency are not what the model was trained for") != std::string::npos;
      });
    };
    EXPECT_FALSE(says_so());
    goal.swimmer.young_modulus_Pa *= 1e3;
    EXPECT_TRUE(says_so());
  }

  TEST_F(Plans, RefuseWhatCannotBeAsked)
  {
    const auto message = [&] {
      try
      {
        plan();
      }
      catch (const InputError &error)
      {
        return std::string(error.what());
      }
      return std::string();
    };
    goal.field.magnitude_T = FieldLimits::none;
    EXPECT_NE(message().find("leave the field unbounded"), std::string::npos);
    goal.field.magnitude_T = 7e-3;
    goal.frequency_Hz      = {2., 1.};
    EXPECT_NE(message().find("no frequency lies between 2 and 1 Hz"), std::string::npos);
  }

  TEST_F(Plans, TurnWithTheDirectionOfTravel)
  {
    options.search.search.max_evaluations = 8;
    const PlanResult straight             = plan();
    goal.field.turn_rad                   = 0.7;
    const PlanResult    turned            = plan();
    const PlannedField &a = *straight.find(tuned_field_name), &b = *turned.find(tuned_field_name);
    EXPECT_NEAR(b.bx_T[0], std::cos(0.7) * a.bx_T[0], 1e-12);
    EXPECT_NEAR(b.by_T[0], std::sin(0.7) * a.bx_T[0], 1e-12);
    RunRequest run    = request;
    run.drive         = drive_of(b);
    run.initial_state = start_of(b);
    run.n_periods     = 1;
    const ReducedSwimmer swimmer(model);
    const SwimmerRun     swum = SwimmerIntegrator(swimmer, {.relative_tolerance = 1e-9}).run(run);
    EXPECT_NEAR(displacement_per_period(swum, 0.7).front(), a.displacement_m, 1e-4 * a.displacement_m);
  }

  TEST_F(Plans, ForManySwimmersAreAsGoodAsTheWorstOfThem)
  {
    const ReducedSwimmer           swimmer(model);
    std::vector<SwimmerParameters> members(3, goal.swimmer);
    members[1].young_modulus_Pa *= 0.8;
    members[2].young_modulus_Pa *= 1.3;
    const PlanResult result = plan_field(model, goal, request.drive, options, members);
    ASSERT_EQ(result.members.size(), 3u);
    double worst_robust = 1., worst_tuned = 1.;
    for (const PlannedMember &member : result.members)
    {
      worst_robust = std::min(worst_robust, member.mean_speed_m_s);
      worst_tuned  = std::min(worst_tuned, member.tuned_speed_m_s);
      EXPECT_LT(member.largest_multiplier, 0.8 * (1. + 1e-3));
    }
    EXPECT_GE(worst_robust, worst_tuned * (1. - 1e-4));
    const FieldTask      task{model, swimmer, goal, {{StrokeTerm::mean_speed, 1e-5}}};
    const FieldVariables variables(1, FieldFamily::sinusoid);
    const FieldStart     start{drive_of(*result.find(tuned_field_name)), start_of(*result.find(tuned_field_name))};
    FieldSearchOptions   few    = options.search;
    few.search.max_evaluations  = 20;
    const FieldFound worst_case = search_robust_field(task, members, 0, variables, start, few);
    const FieldFound best_two   = search_robust_field(task, members, 1, variables, start, few);
    EXPECT_LE(best_two.minimum.objective, worst_case.minimum.objective + 1e-6); // a quantile asks for less
  }

  TEST_F(Plans, StartWhereTheMotionSettlesSoon)
  {
    const ReducedSwimmer swimmer(model);
    const FieldTask      task{model, swimmer, goal, {}};
    const FieldVariables variables(1, FieldFamily::sinusoid);
    const PlannedField   field =
        measured_field("", task, variables.drive(variables.variables(request.drive)), state_at_rest(swimmer));
    RunRequest run     = request;
    run.n_periods      = 2;
    const double angle = settled_start_angle_rad(swimmer, run, start_of(field), 2);
    const auto   to_go = [&](const double from) {
      run.initial_state  = state_at_rest(swimmer, from);
      const SwimmerRun r = SwimmerIntegrator(swimmer, {}).run(run);
      return std::abs(r.at_period_end.back()[2] - field.start[0]);
    };
    EXPECT_LT(to_go(angle), 0.1 * to_go(0.) + 1e-4);
  }
} // namespace swimtwin
