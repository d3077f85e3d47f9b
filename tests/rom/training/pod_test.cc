#include <rom/training/pod.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

extern "C" void dgesvd_(const char *job_u, const char *job_v, const int *m, const int *n, double *a, const int *lda,
                        double *s, double *u, const int *ldu, double *vt, const int *ldvt, double *work,
                        const int *lwork, int *info);

namespace swimtwin
{
  namespace
  {
    Eigen::MatrixXd random_matrix(const Eigen::Index rows, const Eigen::Index columns, const unsigned int seed)
    {
      std::mt19937               generator(seed);
      std::normal_distribution<> normal;
      return Eigen::MatrixXd::NullaryExpr(rows, columns, [&]() { return normal(generator); });
    }

    Eigen::MatrixXd random_orthonormal(const Eigen::Index rows, const Eigen::Index columns, const unsigned int seed)
    {
      const Eigen::HouseholderQR<Eigen::MatrixXd> qr(random_matrix(rows, columns, seed));
      return qr.householderQ() * Eigen::MatrixXd::Identity(rows, columns);
    }

    /// Mass matrix of a chain of linear elements: symmetric, positive definite, not diagonal.
    Eigen::SparseMatrix<double> chain_mass(const Eigen::Index n)
    {
      std::vector<Eigen::Triplet<double>> entries;
      for (Eigen::Index i = 0; i < n; ++i)
      {
        entries.emplace_back(i, i, (4. + double(i) / double(n)) / 6.);
        if (i + 1 < n)
        {
          entries.emplace_back(i, i + 1, 1. / 6.);
          entries.emplace_back(i + 1, i, 1. / 6.);
        }
      }
      Eigen::SparseMatrix<double> M(n, n);
      M.setFromTriplets(entries.begin(), entries.end());
      return M;
    }

    std::vector<double> lapack_singular_values(Eigen::MatrixXd a)
    {
      const int           m = static_cast<int>(a.rows()), n = static_cast<int>(a.cols()), one = 1, size = 20 * (m + n);
      std::vector<double> s(std::min(m, n)), work(size);
      int                 info = 0;
      dgesvd_("N", "N", &m, &n, a.data(), &m, s.data(), nullptr, &one, nullptr, &one, work.data(), &size, &info);
      EXPECT_EQ(info, 0);
      return s;
    }

    /// Snapshots whose singular values in the inner product fall over ten decades.
    class PodTest : public ::testing::Test
    {
    protected:
      static constexpr Eigen::Index n = 150, m = 60, rank = 41;
      Eigen::SparseMatrix<double>   M = chain_mass(n);
      Eigen::MatrixXd               L = Eigen::MatrixXd(Eigen::MatrixXd(M).llt().matrixL());
      Eigen::MatrixXd               X = snapshots();

      Eigen::MatrixXd snapshots() const
      {
        Eigen::VectorXd s(rank);
        for (Eigen::Index k = 0; k < rank; ++k)
          s(k) = 3. * std::pow(10., -10. * double(k) / (rank - 1));
        const Eigen::MatrixXd Y =
            random_orthonormal(n, rank, 1) * s.asDiagonal() * random_orthonormal(m, rank, 2).transpose();
        return L.transpose().triangularView<Eigen::Upper>().solve(Y);
      }

      Pod pod(const int k = 1000) const
      {
        PodBuilder builder(M, MPI_COMM_WORLD);
        builder.add(X);
        return builder.compute(k);
      }
    };
  } // namespace

  TEST_F(PodTest, SingularValuesAreLapacksOverTenDecades)
  {
    const auto expected = lapack_singular_values(L.transpose() * X);
    const auto computed = pod().singular_values;
    ASSERT_GE(computed.size(), rank);
    for (Eigen::Index k = 0; k < rank; ++k)
      EXPECT_NEAR(computed(k), expected[k], 1e-12 * expected[0]);
  }

  TEST_F(PodTest, ModesAreOrthonormalInTheInnerProduct)
  {
    const Eigen::MatrixXd modes = pod(rank).modes;
    EXPECT_LE((modes.transpose() * M * modes - Eigen::MatrixXd::Identity(rank, rank)).cwiseAbs().maxCoeff(), 1e-12);
  }

  // What is left of them is round-off, of which nothing is orthogonal to anything once it is scaled up.
  TEST_F(PodTest, ModesOfManySnapshotsOfFewShapesAreOrthonormalToo)
  {
    PodBuilder builder(M, MPI_COMM_WORLD);
    for (unsigned int seed = 3; seed < 13; ++seed)
      builder.add(X * random_orthonormal(m, m, seed));
    const Eigen::MatrixXd modes = builder.compute(n).modes;
    EXPECT_LE(
        (modes.transpose() * M * modes - Eigen::MatrixXd::Identity(modes.cols(), modes.cols())).cwiseAbs().maxCoeff(),
        1e-12);
    const auto expected = lapack_singular_values(L.transpose() * X);
    const Pod  few      = builder.compute(8);
    for (int k = 0; k < 8; ++k)
      EXPECT_NEAR(few.singular_values(k), std::sqrt(10.) * expected[k], 1e-12 * expected[0]);
  }

  TEST_F(PodTest, ModesLeaveWhatTheFollowingSingularValuesSay)
  {
    const Pod             p    = pod(10);
    const Eigen::MatrixXd left = X - p.modes * (p.modes.transpose() * (M * X));
    EXPECT_NEAR(left.cwiseProduct(M * left).sum(), p.singular_values.tail(p.singular_values.size() - 10).squaredNorm(),
                1e-10 * p.singular_values(10) * p.singular_values(10) + 1e-24);
  }

  TEST_F(PodTest, SnapshotsMayComeFileByFile)
  {
    PodBuilder builder(M, MPI_COMM_WORLD);
    builder.add(X.leftCols(17));
    builder.add(X.middleCols(17, 30));
    builder.add(X.rightCols(m - 47));
    const Pod whole = pod(8), parts = builder.compute(8);
    EXPECT_LE((whole.modes - parts.modes).cwiseAbs().maxCoeff(), 1e-10);
  }

  // Run on two ranks, too: there the basis is shared out.
  TEST_F(PodTest, ModesDoNotDependOnTheNumberOfRanks)
  {
    PodBuilder alone(M, MPI_COMM_SELF);
    alone.add(X);
    EXPECT_LE((alone.compute(8).modes - pod(8).modes).cwiseAbs().maxCoeff(), 1e-10);
  }

  TEST_F(PodTest, RepeatedSnapshotsAddEnergyButNoModes)
  {
    PodBuilder builder(M, MPI_COMM_WORLD);
    builder.add(X.leftCols(5));
    builder.add(X.leftCols(5));
    const Pod twice = builder.compute(100);
    EXPECT_EQ(builder.n_snapshots(), 10);
    const auto once = lapack_singular_values(L.transpose() * X.leftCols(5));
    for (int k = 0; k < 5; ++k)
      EXPECT_NEAR(twice.singular_values(k), std::sqrt(2.) * once[k], 1e-12 * once[0]);
    for (Eigen::Index k = 5; k < twice.singular_values.size(); ++k)
      EXPECT_LE(twice.singular_values(k), 1e-12 * once[0]);
  }

  // More snapshots than unknowns: the basis is full, everything else is a combination.
  TEST(Pod, TakesMoreSnapshotsThanThereAreUnknowns)
  {
    const auto            M = chain_mass(6);
    const Eigen::MatrixXd X = random_matrix(6, 20, 3), L = Eigen::MatrixXd(M).llt().matrixL();
    PodBuilder            builder(M, MPI_COMM_WORLD);
    builder.add(X);
    const Pod  p        = builder.compute(6);
    const auto expected = lapack_singular_values(L.transpose() * X);
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(p.singular_values(k), expected[k], 1e-12 * expected[0]);
  }
} // namespace swimtwin
