#include <rom/training/factor_entries.h>

#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  Eigen::MatrixXd factor_at_rest(const Eigen::MatrixXd &rest, const bool has_mirror)
  {
    Eigen::MatrixXd symmetric = rest;
    for (Eigen::Index i = 0; i < rest.rows(); ++i)
      for (Eigen::Index j = 0; j < rest.cols(); ++j)
        if (has_mirror && velocity_parity(i) * velocity_parity(j) < 0)
          symmetric(i, j) = 0.;
    return cholesky_factor(symmetric);
  }

  Eigen::MatrixXd seen_from(const Eigen::MatrixXd &L, const Eigen::MatrixXd &A)
  {
    const Eigen::MatrixXd half = solve_lower(L, A);
    return solve_lower<Eigen::MatrixXd>(L, half.transpose()).transpose();
  }

  Eigen::VectorXd factor_entries(const Eigen::MatrixXd &L0, const Eigen::MatrixXd &resistance)
  {
    const Eigen::MatrixXd scaled = seen_from(L0, resistance);
    const Eigen::MatrixXd C      = cholesky_factor((scaled + scaled.transpose()) / 2.);
    const Eigen::Index    n      = C.rows();
    Eigen::VectorXd       entries(n * (n + 1) / 2);
    for (Eigen::Index i = 0, k = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j, ++k)
        entries(k) = i == j ? std::log(C(i, i)) : C(i, j);
    return entries;
  }

  Eigen::VectorXd variable_effects(const Eigen::MatrixXd &rest, const std::vector<Eigen::MatrixXd> &axis,
                                   const bool has_mirror)
  {
    const Eigen::MatrixXd L0 = factor_at_rest(rest, has_mirror);
    Eigen::VectorXd       effects(axis.size());
    for (std::size_t i = 0; i < axis.size(); ++i)
      effects(i) = std::max(1e-4, factor_entries(L0, axis[i]).cwiseAbs().maxCoeff());
    return effects;
  }

  Eigen::MatrixXd factor_of(const Eigen::VectorXd &entries, const Eigen::Index n)
  {
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0, k = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j, ++k)
        C(i, j) = i == j ? std::exp(entries(k)) : entries(k);
    return C;
  }

  double relative_error(const Eigen::VectorXd &fitted, const Eigen::VectorXd &truth, const Eigen::Index n)
  {
    const Eigen::MatrixXd D = solve_lower(factor_of(fitted, n), factor_of(truth, n));
    return (D * D.transpose() - Eigen::MatrixXd::Identity(n, n)).operatorNorm();
  }

  double largest_condition(const Eigen::MatrixXd &entries, const Eigen::Index n)
  {
    double largest = 1.;
    for (Eigen::Index k = 0; k < entries.rows(); ++k)
    {
      const Eigen::VectorXd singular = factor_of(entries.row(k).transpose(), n).jacobiSvd().singularValues();
      largest                        = std::max(largest, std::pow(singular(0) / singular(n - 1), 2));
    }
    return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
  }
} // namespace swimtwin
