#include <control/stroke/multiplier_slopes.h>

#include <rom/swimmer/dense_algebra.h>

namespace swimtwin
{
  namespace
  {
    /// The eigenvector of the eigenvalue nearest to `value`, of unit length.
    Eigen::VectorXcd eigenvector(const Eigen::MatrixXd &matrix, const std::complex<double> value)
    {
      const ComplexEigen eigen   = complex_eigen(matrix);
      Eigen::Index       nearest = 0;
      (eigen.values.array() - value).abs().minCoeff(&nearest);
      return eigen.vectors.col(nearest).normalized();
    }
  } // namespace

  /// With right and left eigenvectors r and l, d lambda = l dM r / (l r).
  Eigen::RowVectorXd multiplier_slopes(const Eigen::MatrixXd &M, const std::complex<double> lambda,
                                       const std::function<Eigen::MatrixXd(const Eigen::VectorXd &r)> &change_along)
  {
    constexpr std::complex<double> i(0., 1.);
    const Eigen::VectorXcd         r = eigenvector(M, lambda), l = eigenvector(M.transpose(), lambda);
    Eigen::MatrixXcd               change = change_along(r.real());
    if (lambda.imag() != 0.)
      change += i * change_along(r.imag());
    const std::complex<double> norm = (l.transpose() * r).value() * lambda / std::abs(lambda);
    return (l.transpose() * change / norm).real();
  }
} // namespace swimtwin
