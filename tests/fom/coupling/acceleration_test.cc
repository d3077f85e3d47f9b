#include <fom/coupling/acceleration.h>

#include <gtest/gtest.h>

#include <random>

namespace swimtwin
{
  namespace
  {
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /// S(x) = b - A x: a drag against a stiffness, as the fluid and the tail see each other.
    struct LinearProblem
    {
      MatrixXd A;
      VectorXd b;

      explicit LinearProblem(const VectorXd &eigenvalues)
      {
        std::mt19937                           generator(1);
        std::uniform_real_distribution<double> uniform(-1., 1.);
        const auto                             random = [&] { return uniform(generator); };
        const MatrixXd M = MatrixXd::NullaryExpr(eigenvalues.size(), eigenvalues.size(), random);
        const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(M).householderQ();
        A                = Q * eigenvalues.asDiagonal() * Q.transpose();
        b                = VectorXd::NullaryExpr(eigenvalues.size(), random);
      }

      VectorXd image(const VectorXd &x) const { return b - A * x; }
      VectorXd solution() const { return (MatrixXd::Identity(b.size(), b.size()) + A).lu().solve(b); }

      /// Iterations until the error is below the tolerance; the limit if it never is.
      int solve(Acceleration &acceleration, const double tolerance, const int limit) const
      {
        VectorXd x = VectorXd::Zero(b.size());
        for (int iteration = 1; iteration <= limit; ++iteration)
        {
          x = acceleration.next(x, image(x));
          if ((x - solution()).norm() <= tolerance)
            return iteration;
        }
        return limit;
      }
    };
  } // namespace

  // With one direction the secant is exact: one relaxed step to learn, one to arrive.
  TEST(Acceleration, AitkenSolvesOneDirectionInTwoIterations)
  {
    AitkenRelaxation aitken;
    aitken.forget(0.3);
    const LinearProblem problem(VectorXd::Constant(1, 5.));
    EXPECT_EQ(problem.solve(aitken, 1e-14, 10), 2);
    EXPECT_NEAR(aitken.factor(), 1. / 6., 1e-14);
    // The next problem of the same kind starts with that factor.
    aitken.start();
    EXPECT_EQ(problem.solve(aitken, 1e-14, 10), 1);
  }

  TEST(Acceleration, AitkenConvergesWherePlainIterationDiverges)
  {
    AitkenRelaxation aitken;
    aitken.forget(0.3);
    EXPECT_LE(LinearProblem(VectorXd::LinSpaced(20, 0., 20.)).solve(aitken, 1e-9, 500), 150);
  }

  TEST(Acceleration, AitkenStaysWithinItsBounds)
  {
    AitkenRelaxation aitken;
    aitken.forget(0.3);
    const VectorXd zero = VectorXd::Zero(1), one = VectorXd::Ones(1);
    aitken.next(zero, one);
    aitken.next(zero, 2. * one); // the secant's factor would be negative
    EXPECT_DOUBLE_EQ(aitken.factor(), 0.03);
    aitken.start();
    aitken.next(zero, one);
    aitken.next(zero, 0.99 * one); // the secant's factor would be 3
    EXPECT_DOUBLE_EQ(aitken.factor(), 1.);
  }

  // n independent differences determine a linear map of n directions: n + 1 images and the step that uses them.
  TEST(Acceleration, QuasiNewtonSolvesALinearProblemInAsManyIterationsAsDirections)
  {
    QuasiNewtonLeastSquares quasi_newton(1);
    quasi_newton.forget(0.3);
    const LinearProblem problem(VectorXd::LinSpaced(4, 0.5, 20.));
    EXPECT_LE(problem.solve(quasi_newton, 1e-9, 50), 4 + 1);
    // What it learnt serves the next problem of the same kind at once.
    quasi_newton.start();
    EXPECT_EQ(problem.solve(quasi_newton, 1e-9, 50), 1);
  }

  TEST(Acceleration, QuasiNewtonForgets)
  {
    QuasiNewtonLeastSquares quasi_newton(8);
    quasi_newton.forget(0.3);
    const LinearProblem problem(VectorXd::Constant(2, 3.));
    problem.solve(quasi_newton, 1e-9, 50);
    quasi_newton.forget(0.25);
    const VectorXd x = VectorXd::Zero(2);
    EXPECT_LE((quasi_newton.next(x, problem.image(x)) - 0.25 * problem.b).norm(), 1e-15);
  }
} // namespace swimtwin
