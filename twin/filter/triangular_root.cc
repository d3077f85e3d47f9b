#include <twin/filter/triangular_root.h>

namespace swimtwin
{
  void triangularise(Eigen::Ref<Eigen::MatrixXd> rows, Eigen::Ref<Eigen::VectorXd> workspace)
  {
    const Eigen::Index k = rows.rows(), n = rows.cols();
    for (Eigen::Index j = 0; j < n; ++j)
    {
      double tau = 0., beta = 0.;
      rows.col(j).tail(k - j).makeHouseholderInPlace(tau, beta);
      rows.block(j, j + 1, k - j, n - j - 1)
          .applyHouseholderOnTheLeft(rows.col(j).tail(k - j - 1), tau, workspace.data());
      rows.col(j).tail(k - j).setZero();
      rows(j, j) = beta;
      if (beta < 0.)
        rows.row(j).tail(n - j) *= -1.;
    }
  }
} // namespace swimtwin
