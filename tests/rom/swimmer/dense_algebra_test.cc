#include <rom/swimmer/dense_algebra.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    constexpr double rounding_of_solutions = 1e-12; // of a few hundred operations on numbers of order one

    Eigen::MatrixXd regular_matrix(const Eigen::Index n)
    {
      std::srand(3);
      return Eigen::MatrixXd::Random(n, n) + 3. * Eigen::MatrixXd::Identity(n, n);
    }

    Eigen::MatrixXd positive_matrix(const Eigen::Index n)
    {
      const Eigen::MatrixXd A = regular_matrix(n);
      return A * A.transpose();
    }
  } // namespace

  TEST(DenseAlgebra, SolutionsSolve)
  {
    const Eigen::MatrixXd A = regular_matrix(7), S = positive_matrix(7), B = Eigen::MatrixXd::Random(7, 3);
    const Eigen::VectorXd b = B.col(0);
    EXPECT_LT((A * solve_by_qr(A, B) - B).norm(), rounding_of_solutions);
    EXPECT_LT((A * solve_by_qr(A, b) - b).norm(), rounding_of_solutions);
    EXPECT_LT((A * solve_by_plain_qr(A, B) - B).norm(), rounding_of_solutions);
    EXPECT_LT((A * solve_by_lu(A, B) - B).norm(), rounding_of_solutions);
    EXPECT_LT((S * solve_symmetric(S, B) - B).norm(), rounding_of_solutions);
    const Eigen::MatrixXd L = cholesky_factor(S);
    EXPECT_LT((L * L.transpose() - S).norm(), rounding_of_solutions * S.norm());
    EXPECT_LT((L * solve_lower(L, B) - B).norm(), rounding_of_solutions);
  }

  TEST(DenseAlgebra, ShortestLeastSquaresIsOrthogonalToWhatIsFree)
  {
    Eigen::MatrixXd A(4, 3);
    A << 1., 2., 3., 0., 1., 1., 2., 1., 3., 1., 0., 1.; // the third column is the sum of the others
    const Eigen::VectorXd b = Eigen::Vector4d(1., -2., 0.5, 3.), x = shortest_least_squares(A, b);
    EXPECT_LT((A.transpose() * (A * x - b)).norm(), rounding_of_solutions);
    EXPECT_NEAR(x.dot(Eigen::Vector3d(1., 1., -1.)), 0., rounding_of_solutions);
  }

  TEST(DenseAlgebra, ComplementIsOrthonormalAndOrthogonal)
  {
    const Eigen::MatrixXd columns = Eigen::MatrixXd::Random(6, 2), Z = orthogonal_complement(columns);
    ASSERT_EQ(Z.cols(), 4);
    EXPECT_LT((Z.transpose() * Z - Eigen::MatrixXd::Identity(4, 4)).norm(), rounding_of_solutions);
    EXPECT_LT((Z.transpose() * columns).norm(), rounding_of_solutions);
  }

  TEST(DenseAlgebra, EigenvectorsAndSingularVectorsAreTheirs)
  {
    const Eigen::MatrixXd A = regular_matrix(5), S = positive_matrix(5);
    const SymmetricEigen  symmetric = symmetric_eigen(S);
    EXPECT_LT((S * symmetric.vectors - symmetric.vectors * symmetric.values.asDiagonal()).norm(),
              rounding_of_solutions * S.norm());
    EXPECT_EQ(symmetric.values, symmetric_eigenvalues(S));
    const ComplexEigen general = complex_eigen(A);
    EXPECT_LT((A * general.vectors - general.vectors * general.values.asDiagonal()).norm(),
              10. * rounding_of_solutions);
    const RightSingular svd = right_singular(A);
    EXPECT_LT((A.transpose() * A * svd.vectors - svd.vectors * svd.values.cwiseAbs2().asDiagonal()).norm(),
              10. * rounding_of_solutions * A.squaredNorm());
  }
} // namespace swimtwin
