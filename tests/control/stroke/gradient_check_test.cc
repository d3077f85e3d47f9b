#include <control/stroke/gradient_check.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    SwimmingGoal every_limit(const ReducedModel &model)
    {
      SwimmingGoal goal;
      goal.swimmer                      = example_request(model).parameters;
      goal.field.magnitude_T            = 7e-3;
      goal.field.component_T            = {7e-3, 7e-3};
      goal.field.slew_rate_T_s          = 0.1;
      goal.field.current_per_field_A_T  = Eigen::Matrix2d::Identity() * 1000.;
      goal.field.current_A              = 7.;
      goal.motion.heading_deviation_rad = 1.;
      goal.motion.tail_strain           = 0.1;
      goal.frequency_Hz                 = {0.1, 3.};
      return goal;
    }

    class Gradients : public ::testing::TestWithParam<ExampleOptions>
    {
    };
  } // namespace

  TEST_P(Gradients, OfEveryTermAndLimitAreThoseOfDifferences)
  {
    const ReducedModel   model = example_model(GetParam());
    const ReducedSwimmer swimmer(model, example_densities(GetParam()));
    const FieldVariables variables(2, FieldFamily::general);
    const SwimmingGoal   goal = every_limit(model);
    Eigen::VectorXd      x    = variables.variables(sinusoid_coefficients(*variables.field(), 2e-3, 5e-3), 0.8);
    for (Eigen::Index i = 0; i + 1 < x.size(); ++i)
      x[i] += 5e-4 * std::cos(3. * static_cast<double>(i)); // no symmetry
    for (const GradientCheck &check : check_gradients(model, swimmer, goal, variables, x))
      if (check.size > 0.) // else the second multiplier: too small to matter
      {
        EXPECT_LT(check.difference, 1e-5) << check.name << ", of size " << check.size;
      }
  }

  INSTANTIATE_TEST_SUITE_P(Examples, Gradients,
                           ::testing::Values(ExampleOptions{.n_modes = 2},
                                             ExampleOptions{
                                                 .n_modes = 2, .depends_on_angle = false, .magnetic_tail = false},
                                             ExampleOptions{.n_modes = 3, .keeps_area = true},
                                             ExampleOptions{.n_modes = 2, .has_inertia = true}),
                           [](const auto &instance) { return std::to_string(instance.index); });
} // namespace swimtwin
