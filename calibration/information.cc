#include <calibration/information.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr double smallest_entry = 1e-4; // of a unit direction, that counts as taking part

    /// Of the observations: noise, less sure where the loss gives less weight, and the model's error.
    Eigen::MatrixXd covariance_of_data(const Misfit &misfit, const Prediction &prediction, const double noise_scale)
    {
      const Eigen::VectorXd weights =
          misfit.residuals(prediction).unaryExpr([&](const double r) { return misfit.loss.weight(r); });
      const Eigen::VectorXd variances = (noise_scale * misfit.sigma_m).cwiseAbs2().cwiseQuotient(weights);
      Eigen::MatrixXd       V         = prediction.by_error * prediction.by_error.transpose();
      V.diagonal() += variances;
      return V;
    }

    Eigen::MatrixXd prior_information(const Misfit &misfit)
    {
      Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(misfit.n_parameters());
      for (int j = 0; j < misfit.n_parameters(); ++j)
        if (misfit.map().has_prior(j))
          diagonal[j] = 1. / std::pow(misfit.map().prior_standard_deviation(j), 2);
      return diagonal.asDiagonal();
    }

    /// Observed less predicted with the model's error at its mean.
    Eigen::VectorXd raw_residual(const Misfit &misfit, const Eigen::VectorXd &unknowns, const Prediction &prediction)
    {
      return misfit.observed_m - prediction.value_m + prediction.by_error * unknowns.tail(misfit.n_components());
    }

    /// Directions within the span of `null` that a prior sees less than the data see their weakest direction.
    Eigen::MatrixXd undecided_directions(const Eigen::MatrixXd &null, const Eigen::MatrixXd &prior)
    {
      if (null.cols() == 0)
        return null;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(null.transpose() * prior * null);
      const auto n = (eigen.eigenvalues().array() < 1e-8).count(); // a prior of less than 1e4 in a logarithm decides
      return null * eigen.eigenvectors().leftCols(n);
    }

    /// Inverse of the information on the directions that are decided.
    Eigen::MatrixXd inverse_beside(const Eigen::MatrixXd &information, const Eigen::MatrixXd &undecided)
    {
      const Eigen::Index p = information.rows(), n = undecided.cols();
      if (n == p)
        return Eigen::MatrixXd::Zero(p, p);
      Eigen::MatrixXd Z = Eigen::MatrixXd::Identity(p, p);
      if (n > 0)
        Z = Eigen::MatrixXd(Eigen::HouseholderQR<Eigen::MatrixXd>(undecided).householderQ()).rightCols(p - n);
      const Eigen::MatrixXd inside = Z.transpose() * information * Z;
      return Z * inside.ldlt().solve(Eigen::MatrixXd::Identity(p - n, p - n)) * Z.transpose();
    }

    double log_determinant(const Eigen::MatrixXd &symmetric)
    {
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues();
      const double          least  = std::pow(null_strength, 2) * values.maxCoeff();
      return (values.array() > least).select(values.array().max(1e-300).log(), 0.).sum();
    }

    double median(Eigen::VectorXd values)
    {
      std::sort(values.begin(), values.end());
      const Eigen::Index n = values.size();
      return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
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
    Information                       result;
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance_of_data(misfit, prediction, misfit.noise_scale));
    result.whitened = factor.matrixL().solve(prediction.by_x);
    result.residual = factor.matrixL().solve(raw_residual(misfit, unknowns, prediction));
    result.prior    = prior_information(misfit);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(result.whitened, Eigen::ComputeFullV);
    const Eigen::Index                      p                = result.whitened.cols();
    result.singular_values                                   = Eigen::VectorXd::Zero(p);
    result.singular_values.head(svd.singularValues().size()) = svd.singularValues();
    const auto n_null      = (result.singular_values.array() <= null_strength * result.singular_values[0]).count();
    result.null_directions = svd.matrixV().rightCols(n_null);
    result.undecided       = undecided_directions(result.null_directions, result.prior);
    result.covariance = inverse_beside(result.whitened.transpose() * result.whitened + result.prior, result.undecided);
    return result;
  }

  double noise_scale_estimate(const Misfit &misfit, const Eigen::VectorXd &unknowns, const Prediction &prediction,
                              const double lower, const double upper)
  {
    const Eigen::VectorXd residual = raw_residual(misfit, unknowns, prediction);
    const Eigen::Index    n = residual.size(), p = misfit.n_parameters();
    if (misfit.loss.is_robust())
    {
      constexpr double      of_normal = 1.4826; // standard deviation over median absolute value
      const Eigen::VectorXd r         = misfit.noise_scale * misfit.residuals(prediction);
      const double          growth    = std::sqrt(static_cast<double>(n) / static_cast<double>(n - p));
      return std::clamp(of_normal * growth * median(r.cwiseAbs()), lower, upper);
    }
    const Eigen::MatrixXd prior     = prior_information(misfit);
    const auto            criterion = [&](const double logarithm) {
      const Eigen::MatrixXd             V = covariance_of_data(misfit, prediction, std::exp(logarithm));
      const Eigen::LLT<Eigen::MatrixXd> factor(V);
      const Eigen::MatrixXd             X = factor.matrixL().solve(prediction.by_x);
      const Eigen::VectorXd             e = factor.matrixL().solve(residual);
      return 0.5 * (log_determinant(V) + log_determinant(X.transpose() * X + prior) + e.squaredNorm());
    };
    const auto [best, value] = boost::math::tools::brent_find_minima(criterion, std::log(lower), std::log(upper), 24);
    return std::exp(best);
  }
} // namespace swimtwin
