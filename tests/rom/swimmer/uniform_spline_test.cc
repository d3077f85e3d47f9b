#include <rom/swimmer/uniform_spline.h>

#include <datasets/system/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace swimtwin
{
  namespace
  {
    const std::vector<double> arguments = {0., 0.03, 0.2, 0.4999, 0.71, 0.9, 0.999};

    Eigen::VectorXd some_coefficients(const UniformSpline &spline)
    {
      return Eigen::VectorXd::NullaryExpr(spline.n_coefficients(), [](Eigen::Index i) { return std::sin(3. * i); });
    }
  } // namespace

  TEST(UniformSpline, WeightsSumToOneAndSlopesToZero)
  {
    for (const UniformSpline &spline : {UniformSpline(5, false), UniformSpline(6, true)})
      for (const double s : arguments)
      {
        const auto value = spline.value(s), slope = spline.slope(s);
        EXPECT_NEAR(std::accumulate(value.weight.begin(), value.weight.end(), 0.), 1., 1e-15);
        EXPECT_NEAR(std::accumulate(slope.weight.begin(), slope.weight.end(), 0.), 0., 1e-14);
      }
  }

  TEST(UniformSpline, SlopeIsTheDerivativeOfTheValue)
  {
    constexpr double h = 1e-5;
    for (const UniformSpline &spline : {UniformSpline(5, false), UniformSpline(6, true)})
      for (const double s : arguments)
        if (s > 0.)
        {
          const Eigen::VectorXd c       = some_coefficients(spline);
          const double          forward = UniformSpline::sum(spline.value(s + h), c),
                       backward         = UniformSpline::sum(spline.value(s - h), c);
          EXPECT_NEAR(UniformSpline::sum(spline.slope(s), c), (forward - backward) / (2. * h), 1e-7);
        }
  }

  TEST(UniformSpline, APeriodicOneRepeatsAndAnotherKeepsItsEnds)
  {
    const UniformSpline   periodic(7, true), open(7, false);
    const Eigen::VectorXd a = some_coefficients(periodic), b = some_coefficients(open);
    EXPECT_NEAR(UniformSpline::sum(periodic.value(0.3), a), UniformSpline::sum(periodic.value(2.3), a), 1e-14);
    EXPECT_NEAR(UniformSpline::sum(periodic.value(0.), a), UniformSpline::sum(periodic.value(1. - 1e-13), a), 1e-11);
    EXPECT_EQ(UniformSpline::sum(open.value(1.), b), UniformSpline::sum(open.value(1.7), b));
    EXPECT_EQ(UniformSpline::sum(open.slope(1.7), b), 0.);
  }

  TEST(UniformSpline, FitReturnsACubicExactly)
  {
    const UniformSpline   spline(4, false);
    const Eigen::VectorXd s      = Eigen::VectorXd::LinSpaced(30, 0., 1.);
    const auto            cubic  = [](double x) { return 1. - 2. * x + 3. * x * x - 4. * x * x * x; };
    const Eigen::VectorXd values = s.unaryExpr(cubic), c = spline.fit(s, values);
    for (const double place : arguments)
      EXPECT_NEAR(UniformSpline::sum(spline.value(place), c), cubic(place), 1e-13);
  }

  TEST(UniformSpline, FitOfASinusoidConvergesWithTheFourthPower)
  {
    const auto error = [](const int n) {
      const UniformSpline   spline(n, true);
      const Eigen::VectorXd s      = Eigen::VectorXd::LinSpaced(8 * n, 0., 1. - 1. / (8 * n));
      const auto            wave   = [](double x) { return std::sin(2. * std::numbers::pi * x); };
      const Eigen::VectorXd values = s.unaryExpr(wave), c = spline.fit(s, values);
      double                largest = 0.;
      for (int i = 0; i < 1000; ++i)
        largest = std::max(largest, std::abs(UniformSpline::sum(spline.value(i / 1000.), c) - wave(i / 1000.)));
      return largest;
    };
    EXPECT_NEAR(std::log2(error(8) / error(16)), 4., 0.3);
  }

  TEST(UniformSpline, RefusesTooFewIntervals)
  {
    EXPECT_THROW(UniformSpline(3, true), InputError);
    EXPECT_THROW(UniformSpline(0, false), InputError);
  }
} // namespace swimtwin
