#include <calibration/fit/noise_level.h>

#include <calibration/fit/information.h>
#include <rom/swimmer/dense_algebra.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    double log_determinant(const Eigen::MatrixXd &symmetric)
    {
      const Eigen::VectorXd values = symmetric_eigenvalues(symmetric);
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

  const FreeParameter *free_noise_scale(const CalibrationProblem &problem)
  {
    const auto found = std::find_if(problem.free.begin(), problem.free.end(), [](const FreeParameter &free) {
      return free.quantity == FittedQuantity::noise_scale;
    });
    return found == problem.free.end() ? nullptr : &*found;
  }

  double noise_scale_estimate(const Misfit &misfit, const Eigen::VectorXd &unknowns, const Prediction &prediction,
                              const double lower, const double upper)
  {
    const Eigen::VectorXd residual = misfit.mean_residual(unknowns, prediction);
    const Eigen::Index    n = residual.size(), p = misfit.n_parameters();
    if (misfit.loss.is_robust())
    {
      constexpr double      of_normal = 1.4826; // standard deviation over median absolute value
      const Eigen::VectorXd r         = misfit.noise_scale * misfit.residuals(prediction);
      const double          growth    = std::sqrt(static_cast<double>(n) / static_cast<double>(n - p));
      return std::clamp(of_normal * growth * median(r.cwiseAbs()), lower, upper);
    }
    const Eigen::MatrixXd prior     = misfit.prior_information();
    const auto            criterion = [&](const double logarithm) {
      const Eigen::MatrixXd V = misfit.covariance(prediction, std::exp(logarithm));
      const Eigen::MatrixXd L = cholesky_factor(V);
      const Eigen::MatrixXd X = solve_lower(L, prediction.by_x);
      const Eigen::VectorXd e = solve_lower(L, residual);
      return 0.5 * (log_determinant(V) + log_determinant(X.transpose() * X + prior) + e.squaredNorm());
    };
    const auto [best, value] = boost::math::tools::brent_find_minima(criterion, std::log(lower), std::log(upper), 24);
    return std::exp(best);
  }
} // namespace swimtwin
