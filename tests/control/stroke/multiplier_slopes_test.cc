#include <control/stroke/multiplier_slopes.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace swimtwin
{
  namespace
  {
    Eigen::Matrix3d map(const Eigen::Vector2d &p)
    {
      Eigen::Matrix3d M;
      M << 0.5 + 0.3 * p[0], -0.4 + p[1], 0.1, 0.3 * (1. + p[0] * p[1]), 0.4, 0.2 * p[0], 0.05 * p[1], 0.1, 0.2 - p[0];
      return M;
    }

    std::vector<std::complex<double>> eigenvalues(const Eigen::Vector2d &p)
    {
      const Eigen::Vector3cd values = Eigen::EigenSolver<Eigen::Matrix3d>(map(p)).eigenvalues();
      return {values.begin(), values.end()};
    }

    std::complex<double> nearest(const Eigen::Vector2d &p, const std::complex<double> to)
    {
      const auto values = eigenvalues(p);
      return *std::min_element(values.begin(), values.end(),
                               [&](const auto a, const auto b) { return std::abs(a - to) < std::abs(b - to); });
    }
  } // namespace

  TEST(MultiplierSlopes, AreThoseOfDifferencesForRealOnesAndPairs)
  {
    const Eigen::Vector2d p(0.1, 0.05);
    constexpr double      h         = 1e-6;
    int                   n_complex = 0;
    const auto            change    = [&](const Eigen::VectorXd &r) {
      Eigen::MatrixXd columns(3, 2);
      for (int j = 0; j < 2; ++j)
        columns.col(j) = (map(p + h * Eigen::Vector2d::Unit(j)) - map(p - h * Eigen::Vector2d::Unit(j))) * r / (2. * h);
      return columns;
    };
    for (const std::complex<double> lambda : eigenvalues(p))
    {
      n_complex += lambda.imag() != 0.;
      const Eigen::RowVectorXd slopes = multiplier_slopes(map(p), lambda, change);
      for (int j = 0; j < 2; ++j)
      {
        const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(j);
        const double          difference =
            (std::abs(nearest(p + step, lambda)) - std::abs(nearest(p - step, lambda))) / (2. * h);
        EXPECT_NEAR(slopes[j], difference, 1e-8) << lambda;
      }
    }
    EXPECT_EQ(n_complex, 2); // a pair and a real one
  }
} // namespace swimtwin
