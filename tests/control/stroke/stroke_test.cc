#include <control/stroke/stroke_terms.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    class Strokes : public ::testing::Test
    {
    protected:
      Strokes()
      {
        request.drive.field                                    = field;
        request.drive.parameters                               = sinusoid_coefficients(*field, 5e-3, 5e-3);
        request.drive.parameters[field->series().cosine(0, 2)] = 1e-3;
        request.drive.parameters[field->series().sine(1, 2)]   = 0.5e-3;
      }

      Stroke stroke(const int n_samples = 48) const
      {
        return StrokeFinder(swimmer, {.relative_tolerance = 1e-9, .closure = 1e-8, .n_samples = n_samples})
            .find(request, false);
      }

      const ReducedModel                  model   = example_model();
      const ReducedSwimmer                swimmer = ReducedSwimmer(model);
      std::shared_ptr<const FourierField> field   = std::make_shared<FourierField>(2);
      RunRequest                          request = example_request(model);
    };
  } // namespace

  TEST_F(Strokes, AreThePeriodicMotion)
  {
    const Stroke found = stroke();
    ASSERT_TRUE(found.found()) << found.failure;
    ASSERT_EQ(found.samples.size(), 48u);
    RunRequest again         = found.request;
    again.n_periods          = 3;
    again.samples_per_period = 0;
    const SwimmerRun run     = SwimmerIntegrator(swimmer, {.relative_tolerance = 1e-9}).run(again);
    EXPECT_LT((run.at_period_end.back().tail(5) - found.orbit.start.tail(5)).norm(), 1e-6);
    EXPECT_NEAR(evaluate(StrokeTerm::displacement, swimmer, *field, found, 0.).value,
                displacement_per_period(run, 0.).back(), 1e-10);
  }

  TEST_F(Strokes, WorkIsWhatTheFluidTakes)
  {
    const Stroke     found = stroke(96);
    const SwimmerRun run =
        SwimmerIntegrator(swimmer, {.relative_tolerance = 1e-9, .with_work = true}).run(found.request);
    const double work = evaluate(StrokeTerm::magnetic_work, swimmer, *field, found, 0.).value;
    EXPECT_NEAR(work, run.work.front().dissipated, 1e-5 * work);
    const double speed = evaluate(StrokeTerm::mean_speed, swimmer, *field, found, 0.).value;
    EXPECT_NEAR(evaluate(StrokeTerm::efficiency, swimmer, *field, found, 0.).value,
                request.parameters.viscosity_Pa_s * speed * speed / (work * request.drive.frequency_Hz), 1e-12);
  }

  /// What is stored in moving masses comes back within the period.
  TEST_F(Strokes, WithInertiaArePeriodicAndTheirWorkIsWhatTheFluidTakes)
  {
    const ExampleOptions heavy{.has_inertia = true};
    const ReducedModel   heavy_model = example_model(heavy);
    const ReducedSwimmer other(heavy_model, example_densities(heavy));
    RunRequest           started = request;
    started.initial_state        = state_at_rest(other);
    const Stroke found =
        StrokeFinder(other, {.relative_tolerance = 1e-9, .closure = 1e-8, .n_samples = 96}).find(started, false);
    ASSERT_TRUE(found.found()) << found.failure;
    const SwimmerRun run = SwimmerIntegrator(other, {.relative_tolerance = 1e-9, .with_work = true}).run(found.request);
    const SwimmerState &start = run.at_period_end.front(), &end = run.at_period_end.back();
    EXPECT_LT((end - start).segment(2, 5).norm(), 1e-6);
    EXPECT_LT(std::abs(run.work.front().kinetic_change), 1e-5 * run.work.front().dissipated);
    const double work = evaluate(StrokeTerm::magnetic_work, other, *field, found, 0.).value;
    EXPECT_NEAR(work, run.work.front().dissipated, 1e-5 * work);
  }

  TEST_F(Strokes, CopperLossIsTheIntegralOfTheFieldSquared)
  {
    const Stroke  found = stroke();
    double        sum   = 0.;
    constexpr int n     = 100;
    for (int i = 0; i < n; ++i)
      sum += request.drive.field->value_T(static_cast<double>(i) / n, request.drive.parameters).squaredNorm() / n;
    EXPECT_NEAR(evaluate(StrokeTerm::mean_square_field, swimmer, *field, found, 0.).value, sum, 1e-12 * sum);
    EXPECT_NEAR(evaluate(StrokeTerm::copper_loss, swimmer, *field, found, 0.).value, sum / request.drive.frequency_Hz,
                1e-12 * sum);
  }

  TEST_F(Strokes, SayWhyThereIsNone)
  {
    request.drive.parameters.setZero();
    const ReducedModel   open_model = example_model({.depends_on_angle = false});
    const ReducedSwimmer open(open_model);
    const Stroke         none = StrokeFinder(open, {}).find(request, true);
    EXPECT_FALSE(none.found());
    EXPECT_NE(none.failure.find("neutral"), std::string::npos);
  }
} // namespace swimtwin
