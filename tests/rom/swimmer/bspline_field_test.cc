#include <rom/swimmer/bspline_field.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    const std::vector<double> phases = {0., 0.1, 0.37, 0.5, 0.83, 0.99};

    Eigen::VectorXd some_parameters(const DrivingField &field)
    {
      const auto n = static_cast<Eigen::Index>(field.parameter_names().size());
      return Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return 5e-3 * std::cos(2. * i); });
    }

    const Drive sinusoid = {std::make_shared<SinusoidalField>(), Eigen::Vector2d(5e-3, 4e-3), 0.8};
  } // namespace

  TEST(BSplineField, IsLinearInItsParametersAndPullsBackAccordingly)
  {
    for (const bool is_periodic : {false, true})
    {
      const BSplineField    field(UniformSpline(9, is_periodic));
      const Eigen::VectorXd p = some_parameters(field);
      for (const double phase : phases)
      {
        const Eigen::Matrix2Xd slopes = field.slopes(phase, p);
        EXPECT_LE((slopes * p - field.value_T(phase, p)).norm(), 1e-17);
        Eigen::VectorXd pulled = Eigen::VectorXd::Ones(p.size());
        field.pull_back(phase, p, {2., -3.}, pulled);
        EXPECT_LE((pulled - Eigen::VectorXd::Ones(p.size()) - slopes.transpose() * Eigen::Vector2d(2., -3.)).norm(),
                  1e-14);
      }
    }
  }

  TEST(BSplineField, OtherFieldsPullBackByTheirSlopesToo)
  {
    const PiecewiseLinearField field({0., 0.3, 0.7});
    const Eigen::VectorXd      p = some_parameters(field);
    for (const double phase : phases)
    {
      Eigen::VectorXd pulled = Eigen::VectorXd::Zero(p.size());
      field.pull_back(phase, p, {2., -3.}, pulled);
      EXPECT_LE((pulled - field.slopes(phase, p).transpose() * Eigen::Vector2d(2., -3.)).norm(), 1e-15);
    }
  }

  TEST(BSplineField, StaysWithinItsCoefficients)
  {
    const BSplineField    field(UniformSpline(12, true));
    const Eigen::VectorXd p = some_parameters(field);
    for (int i = 0; i < 1000; ++i)
      EXPECT_LE(field.value_T(i / 1000., p).lpNorm<Eigen::Infinity>(), p.lpNorm<Eigen::Infinity>());
  }

  TEST(BSplineField, RateIsTheDerivativeOfTheField)
  {
    constexpr double      h = 1e-5;
    const BSplineField    field(UniformSpline(9, false));
    const Eigen::VectorXd p = some_parameters(field);
    for (const double phase : {0.1, 0.37, 0.83})
      EXPECT_LE(
          ((field.value_T(phase + h, p) - field.value_T(phase - h, p)) / (2. * h) - field.rate_T(phase, p)).norm(),
          1e-9);
  }

  TEST(BSplineField, TakesTheShapeOfAnotherDriveOverSeveralOfItsPeriods)
  {
    const Drive one = spline_drive(sinusoid, 16, true), three = spline_drive(sinusoid, 48, false, 3);
    EXPECT_EQ(one.frequency_Hz, sinusoid.frequency_Hz);
    EXPECT_DOUBLE_EQ(3. * three.frequency_Hz, sinusoid.frequency_Hz);
    for (const double phase : phases)
    {
      const Eigen::Vector2d exact = sinusoid.field->value_T(phase, sinusoid.parameters);
      EXPECT_LE((one.field->value_T(phase, one.parameters) - exact).norm(), 2e-4 * 5e-3);
      EXPECT_LE((three.field->value_T(phase / 3., three.parameters) - exact).norm(), 4e-4 * 5e-3);
    }
  }
} // namespace swimtwin
