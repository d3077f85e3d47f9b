// What is believed of a state: a mean and how far it may be off.
#pragma once

#include <Eigen/Dense>

namespace swimtwin
{
  struct Belief
  {
    Eigen::VectorXd mean; ///< n
    Eigen::MatrixXd root; ///< n x n, lower triangular: the covariance is root root^T

    static Belief independent(const Eigen::VectorXd &mean, const Eigen::VectorXd &standard_deviation)
    {
      return {mean, standard_deviation.asDiagonal()};
    }

    Eigen::Index    size() const { return mean.size(); }
    Eigen::MatrixXd covariance() const { return root * root.transpose(); }
    double          standard_deviation(const Eigen::Index i) const { return root.row(i).norm(); }
    /// (x - mean)^T covariance^-1 (x - mean): chi-squared with n degrees of freedom if x is the truth.
    double distance_squared(const Eigen::VectorXd &x) const
    {
      return root.triangularView<Eigen::Lower>().solve(x - mean).squaredNorm();
    }
  };
} // namespace swimtwin
