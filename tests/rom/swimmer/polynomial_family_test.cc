#include <rom/swimmer/polynomial_family.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace swimtwin
{
  namespace
  {
    // Even, odd and of neither parity where the second coordinate is odd; one has a derivative with monomials that no
    // polynomial has, one vanishes.
    const Eigen::MatrixXi exponents = (Eigen::MatrixXi(6, 2) << 3, 2, 0, 2, 2, 1, 0, 3, 1, 0, 0, 0).finished();
    const Eigen::MatrixXd by_row = (Eigen::MatrixXd(4, 6) << 2., -1., 0., 0., 3., .5, 0., 0., 4., -2., 0., 0., 1., 0.,
                                    1., 0., 0., 0., Eigen::RowVectorXd::Zero(6))
                                       .finished();
    const Eigen::VectorXi parity = Eigen::Vector2i(1, -1);

    double power(const double z, const int n)
    {
      return n < 0 ? 0. : std::pow(z, n);
    }

    class PolynomialFamilyTest : public testing::Test
    {
    protected:
      PolynomialFamilyTest()
      {
        family.emplace(monomials, by_row.transpose());
        results.setConstant(family->n_results(), NAN);
        values.resize(monomials.size());
        monomials.evaluate(z, values);
      }

      const Eigen::Vector2d           z{.7, -1.3};
      const MonomialTable             monomials{exponents, parity};
      std::optional<PolynomialFamily> family;
      Eigen::VectorXd                 values, results;
    };

    TEST_F(PolynomialFamilyTest, HasTheValuesAndDerivativesOfItsPolynomials)
    {
      family->differentiate(values, results);
      for (int p = 0; p < by_row.rows(); ++p)
      {
        double value = 0., by_first = 0., by_second = 0.;
        for (int f = 0; f < exponents.rows(); ++f)
        {
          const int a = exponents(f, 0), b = exponents(f, 1);
          value += by_row(p, f) * power(z[0], a) * power(z[1], b);
          by_first += by_row(p, f) * a * power(z[0], a - 1) * power(z[1], b);
          by_second += by_row(p, f) * b * power(z[0], a) * power(z[1], b - 1);
        }
        EXPECT_NEAR(results[family->value_place(p)], value, 1e-14);
        EXPECT_NEAR(results[family->slope_place(p, 0)], by_first, 1e-14);
        EXPECT_NEAR(results[family->slope_place(p, 1)], by_second, 1e-14);
      }
    }

    TEST_F(PolynomialFamilyTest, LeavesDerivativesAloneWhereOnlyValuesAreAskedFor)
    {
      family->evaluate(values, results);
      for (int p = 0; p < by_row.rows(); ++p)
      {
        EXPECT_TRUE(std::isfinite(results[family->value_place(p)]));
        EXPECT_TRUE(std::isnan(results[family->slope_place(p, 0)]));
      }
    }

    TEST_F(PolynomialFamilyTest, StandsBesideMonomialsThatAreDifferentiatedThemselves)
    {
      Eigen::MatrixXd with_gradient(monomials.size(), 3);
      monomials.evaluate_with_gradient(z, with_gradient);
      const Eigen::MatrixXd one = monomials.in_order(Eigen::MatrixXd::Identity(exponents.rows(), exponents.rows()));
      for (int f = 0; f < exponents.rows(); ++f)
        EXPECT_NEAR(one.col(f).dot(with_gradient.col(2)),
                    exponents(f, 1) * power(z[0], exponents(f, 0)) * power(z[1], exponents(f, 1) - 1), 1e-14);
    }
  } // namespace
} // namespace swimtwin
