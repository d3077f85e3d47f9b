#include <rom/swimmer/wide_product.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    TEST(WideProduct, IsEigensForAnySizeAndLeavesWhatFollowsAlone)
    {
      for (const Eigen::Index n_rows : {0, 1, 3, 4, 5, 17, 98})
        for (const Eigen::Index n_columns : {0, 1, 2, 3, 4, 5, 8, 11})
        {
          const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n_rows, n_columns);
          const Eigen::VectorXd x = Eigen::VectorXd::Random(n_columns);
          Eigen::VectorXd       y = Eigen::VectorXd::Constant(n_rows + 1, 7.);
          set_product(A, x.data(), y.data());
          EXPECT_LE((y.head(n_rows) - A * x).cwiseAbs().sum(), 1e-14 * static_cast<double>(1 + n_rows * n_columns));
          EXPECT_EQ(y[n_rows], 7.) << n_rows << " x " << n_columns;
        }
    }
  } // namespace
} // namespace swimtwin
