#include <control/field/field_variables.h>
#include <control/goal/measured_field.h>
#include <tests/rom/example_model.h>

#include <datasets/system/error.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    Eigen::VectorXd any_coefficients(const FourierField &field)
    {
      RandomNumbers random(7);
      return 1e-3 * random.vector(field.series().n_coefficients());
    }
  } // namespace

  TEST(FourierField, HasTheReferenceSinusoidExactly)
  {
    const FourierField    field(3);
    const SinusoidalField sinusoid;
    const Eigen::VectorXd c = sinusoid_coefficients(field, 4e-3, 5e-3);
    for (const double phase : {0., 0.1, 0.37, 0.5, 0.99})
      EXPECT_EQ(field.value_T(phase, c), sinusoid.value_T(phase, Eigen::Vector2d(4e-3, 5e-3)));
  }

  TEST(FourierField, SlopesAndRatesAreDerivatives)
  {
    const FourierField    field(2);
    const Eigen::VectorXd c     = any_coefficients(field);
    constexpr double      phase = 0.23, h = 1e-6;
    const Eigen::Vector2d rate =
        (field.value_T(phase + h, c) - field.value_T(phase - h, c)) / (2. * h); // of second order
    EXPECT_LT((field.series().rate(phase, c) - rate).norm(), 1e-8 * rate.norm());
    EXPECT_LT((field.slopes(phase, c) * c - field.value_T(phase, c)).norm(), 1e-18); // linear in the coefficients
    EXPECT_LT((field.series().rate_slopes(phase) * c - field.series().rate(phase, c)).norm(), 1e-16);
    EXPECT_EQ(field.parameter_names().size(), static_cast<std::size_t>(c.size()));
    EXPECT_EQ(field.parameter_names()[static_cast<std::size_t>(field.series().sine(1, 2))], "by_sin_2_T");
  }

  TEST(FourierField, ComesBackFromItsOwnValues)
  {
    const auto            field = std::make_shared<FourierField>(4);
    const Eigen::VectorXd c     = any_coefficients(*field);
    EXPECT_LT((fitted_coefficients(*field, {field, c, 1.}) - c).norm(), 1e-15);
    const FourierField longer(6);
    EXPECT_EQ(with_harmonics(longer, with_harmonics(*field, c, longer), *field), c);
  }

  TEST(FourierField, ThreeComponentsAreAMatterOfSize)
  {
    const FourierSeries<3> series(2);
    RandomNumbers          random(3);
    const Eigen::VectorXd  c = random.vector(series.n_coefficients());
    EXPECT_EQ(series.n_coefficients(), 15);
    EXPECT_LT((series.slopes(0.4) * c - series.value(0.4, c)).norm(), 1e-14);
  }

  TEST(FourierField, IsExportedAtTheCoilsRate)
  {
    const auto         field   = std::make_shared<FourierField>(2);
    const Drive        drive   = {field, any_coefficients(*field), 0.8};
    const FieldProgram program = sampled_program(drive, 1000.);
    EXPECT_EQ(program.time_s().size(), 1250u);
    EXPECT_DOUBLE_EQ(program.period_s(), 1.25);
    const auto b = program(0.5);
    EXPECT_NEAR(b[0], field->value_T(0.4, drive.parameters).x(), 1e-12);
    EXPECT_NEAR(b[1], field->value_T(0.4, drive.parameters).y(), 1e-12);
  }

  TEST(FieldVariables, FixThePhase)
  {
    const FieldVariables general(3, FieldFamily::general), symmetric(3, FieldFamily::symmetric),
        sinusoid(3, FieldFamily::sinusoid);
    EXPECT_EQ(general.size(), 2 * 7 - 1 + 1);
    EXPECT_EQ(symmetric.names(), (std::vector<std::string>{"bx_bias_T", "bx_cos_2_T", "bx_sin_2_T", "by_sin_1_T",
                                                           "by_cos_3_T", "by_sin_3_T", "frequency_Hz"}));
    EXPECT_EQ(sinusoid.names(), (std::vector<std::string>{"bx_bias_T", "by_sin_1_T", "frequency_Hz"}));
    for (const std::string &name : general.names())
      EXPECT_NE(name, "by_cos_1_T");
  }

  TEST(FieldVariables, SymmetricFieldsAreTheirMirrorImageHalfAPeriodLater)
  {
    const FieldVariables  variables(5, FieldFamily::symmetric);
    RandomNumbers         random(5);
    const Drive           drive = variables.drive(random.vector(variables.size()));
    const Eigen::Vector2d now   = drive.field->value_T(0.2, drive.parameters),
                          later = drive.field->value_T(0.7, drive.parameters);
    EXPECT_NEAR(now.x(), later.x(), 1e-14);
    EXPECT_NEAR(now.y(), -later.y(), 1e-14);
  }

  TEST(FourierField, RefusesToStandStill)
  {
    EXPECT_THROW(FourierField(0), InputError);
  }
} // namespace swimtwin
