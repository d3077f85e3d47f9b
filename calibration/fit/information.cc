#include <calibration/fit/information.h>

#include <rom/swimmer/dense_algebra.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr double smallest_entry = 1e-4; // of a unit direction, that counts as taking part

    /// Directions within the span of `null` that a prior sees less than the data see their weakest direction.
    Eigen::MatrixXd undecided_directions(const Eigen::MatrixXd &null, const Eigen::MatrixXd &prior)
    {
      if (null.cols() == 0)
        return null;
      const SymmetricEigen eigen = symmetric_eigen(null.transpose() * prior * null);
      const auto           n = (eigen.values.array() < 1e-8).count(); // a prior of less than 1e4 in a logarithm decides
      return null * eigen.vectors.leftCols(n);
    }

    /// Inverse of the information on the directions that are decided.
    Eigen::MatrixXd inverse_beside(const Eigen::MatrixXd &information, const Eigen::MatrixXd &undecided)
    {
      const Eigen::Index p = information.rows(), n = undecided.cols();
      if (n == p)
        return Eigen::MatrixXd::Zero(p, p);
      Eigen::MatrixXd Z = Eigen::MatrixXd::Identity(p, p);
      if (n > 0)
        Z = orthogonal_complement(undecided);
      const Eigen::MatrixXd inside = Z.transpose() * information * Z;
      return Z * solve_symmetric<Eigen::MatrixXd>(inside, Eigen::MatrixXd::Identity(p - n, p - n)) * Z.transpose();
    }
  } // namespace

  bool Information::touches_undecided(const int parameter) const
  {
    return undecided.cols() > 0 && undecided.row(parameter).cwiseAbs().maxCoeff() > smallest_entry;
  }

  double Information::standard_deviation(const Eigen::VectorXd &combination) const
  {
    if (undecided.cols() > 0 && (undecided.transpose() * combination).norm() > smallest_entry * combination.norm())
      return std::numeric_limits<double>::infinity();
    return std::sqrt(combination.dot(covariance * combination));
  }

  Information information(const Misfit &misfit, const Eigen::VectorXd &unknowns, const Prediction &prediction)
  {
    Information           result;
    const Eigen::MatrixXd L = cholesky_factor(misfit.covariance(prediction, misfit.noise_scale));
    result.whitened         = solve_lower<Eigen::MatrixXd>(L, prediction.by_x);
    result.residual         = solve_lower<Eigen::VectorXd>(L, misfit.mean_residual(unknowns, prediction));
    result.prior            = misfit.prior_information();
    const RightSingular svd = right_singular(result.whitened);
    const Eigen::Index  p   = result.whitened.cols();
    result.singular_values  = Eigen::VectorXd::Zero(p);
    result.singular_values.head(svd.values.size()) = svd.values;
    const auto n_null      = (result.singular_values.array() <= null_strength * result.singular_values[0]).count();
    result.null_directions = svd.vectors.rightCols(n_null);
    result.undecided       = undecided_directions(result.null_directions, result.prior);
    result.covariance = inverse_beside(result.whitened.transpose() * result.whitened + result.prior, result.undecided);
    return result;
  }
} // namespace swimtwin
