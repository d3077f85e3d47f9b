#include <optimization/nonnegative_least_squares.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    TEST(NonnegativeLeastSquares, SolutionMeetsItsOptimalityConditions)
    {
      std::srand(7);
      for (int n_trials = 0; n_trials < 50; ++n_trials)
      {
        const Eigen::MatrixXd A = Eigen::MatrixXd::Random(8, 5);
        const Eigen::VectorXd b = Eigen::VectorXd::Random(8), c = nonnegative_least_squares(A, b);
        const Eigen::VectorXd descent = A.transpose() * (b - A * c);
        EXPECT_GE(c.minCoeff(), 0.);
        EXPECT_LE(descent.maxCoeff(), 1e-10);
        EXPECT_NEAR(descent.dot(c), 0., 1e-10); // complementary
      }
    }

    TEST(NonnegativeLeastSquares, ColumnsThatRepeatAreNoHarm)
    {
      Eigen::MatrixXd A(2, 3);
      A << 1., 1., 0., 0., 0., 1.;
      const Eigen::VectorXd c = nonnegative_least_squares(A, Eigen::Vector2d(2., -1.));
      EXPECT_NEAR(c[0] + c[1], 2., 1e-12);
      EXPECT_EQ(c[2], 0.);
    }

    TEST(NonnegativeLeastSquares, NoColumnsIsNoCoefficients)
    {
      EXPECT_EQ(nonnegative_least_squares(Eigen::MatrixXd(3, 0), Eigen::Vector3d(1., 2., 3.)).size(), 0);
    }
  } // namespace
} // namespace swimtwin
