#include <control/field/field_limits.h>
#include <tests/rom/example_model.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    FieldLimits all_limits()
    {
      FieldLimits limits;
      limits.magnitude_T   = 4e-3;
      limits.component_T   = {3e-3, 2e-3};
      limits.slew_rate_T_s = 0.05;
      limits.current_per_field_A_T.resize(3, 2);
      limits.current_per_field_A_T << 1000., 0., 500., 800., -500., 800.;
      limits.current_A = 3.;
      limits.turn_rad  = 0.4;
      return limits;
    }
  } // namespace

  class Limits : public ::testing::TestWithParam<int>
  {
  protected:
    const FourierField    field        = FourierField(GetParam());
    const LimitedField    limited      = LimitedField(field, all_limits());
    RandomNumbers         random       = RandomNumbers(static_cast<unsigned>(GetParam()));
    const Eigen::VectorXd coefficients = 1e-3 * random.vector(field.series().n_coefficients());
  };

  TEST_P(Limits, HoldAtEveryInstant)
  {
    const double found = limited.evaluate(coefficients, 0.8).values.maxCoeff();
    const double dense = limited.largest_of(20'000, coefficients, 0.8);
    EXPECT_GE(found, dense - 1e-12);
    EXPECT_LT(found, dense + 1e-4 * std::abs(dense)); // the grid may miss the peak by half its step
  }

  TEST_P(Limits, HaveTheirSlopes)
  {
    const LimitValues here = limited.evaluate(coefficients, 0.8);
    RandomNumbers     other(9);
    Eigen::VectorXd   direction = other.vector(coefficients.size() + 1);
    direction.head(coefficients.size()) *= 1e-3;
    constexpr double h  = 1e-5;
    const auto       at = [&](const double s) {
      return limited.evaluate(coefficients + s * direction.head(coefficients.size()), 0.8 + s * direction.tail(1)[0])
          .values;
    };
    const Eigen::VectorXd differences = (at(h) - at(-h)) / (2. * h), slopes = here.slopes * direction;
    EXPECT_LT((differences - slopes).lpNorm<Eigen::Infinity>(), 1e-5 * slopes.lpNorm<Eigen::Infinity>());
  }

  INSTANTIATE_TEST_SUITE_P(Harmonics, Limits, ::testing::Values(1, 3, 5, 9));

  TEST(FieldLimits, BoundTheMagnitudeByComponentsOrCoils)
  {
    FieldLimits limits;
    EXPECT_TRUE(std::isinf(FieldLimits().magnitude_T));
    limits.current_per_field_A_T.resize(2, 2);
    limits.current_per_field_A_T << 500., 0., 0., 1000.;
    limits.current_A = 2.;
    const FourierField    field(1);
    const Eigen::VectorXd c = sinusoid_coefficients(field, 2e-3, 3e-3);
    EXPECT_NEAR(LimitedField(field, limits).evaluate(c, 1.).values.maxCoeff(), 3. * 3. / 4. - 1., 1e-12); // coil 2
  }

  TEST(FieldLimits, NameWhatTheyBound)
  {
    FieldLimits limits;
    limits.magnitude_T = 7e-3;
    const LimitedField limited(FourierField(1), limits);
    EXPECT_EQ(limited.size(), 12);
    EXPECT_EQ(limited.names()[3], "|B| <= 0.007 T near phase 0.250");
  }
} // namespace swimtwin
