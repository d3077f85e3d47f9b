#include <calibration/misfit/misfit.h>

#include <cmath>

namespace swimtwin
{
  int Misfit::n_rows() const
  {
    int n_priors = 0;
    for (int j = 0; j < map_.size(); ++j)
      n_priors += map_.has_prior(j) ? 1 : 0;
    return static_cast<int>(observed_m.size()) + n_components() + n_priors;
  }

  Prediction Misfit::predict(DisplacementSource &source, const Eigen::VectorXd &unknowns, const bool derivatives) const
  {
    const Eigen::VectorXd   x = unknowns.head(n_parameters()), z = unknowns.tail(n_components());
    const CalibratedSwimmer swimmer = map_.swimmer(x);
    const Displacements    &motion  = source.evaluate(swimmer, derivatives);
    Prediction              prediction;
    prediction.failure = motion.failure;
    if (motion.failed())
      return prediction;
    const double          scale  = swimmer.displacement_scale * swimmer.geometry_scale;
    const Eigen::VectorXd factor = scale * (Eigen::VectorXd::Ones(motion.value_m.size()) + error_.factor * z);
    const Eigen::VectorXd scaled = motion.value_m.cwiseProduct(factor);
    prediction.value_m           = (scaled.array() + swimmer.displacement_offset_m).matrix();
    prediction.by_error          = scale * motion.value_m.asDiagonal() * error_.factor;
    if (!derivatives)
      return prediction;
    Eigen::MatrixXd by_quantities(scaled.size(), static_cast<Eigen::Index>(n_recording_quantities));
    by_quantities << factor.asDiagonal() * motion.by_logarithm, scaled, scaled, Eigen::VectorXd::Ones(scaled.size());
    prediction.by_x = by_quantities * map_.slopes(x);
    return prediction;
  }

  Eigen::VectorXd Misfit::residuals(const Prediction &prediction) const
  {
    return (observed_m - prediction.value_m).cwiseQuotient(noise_scale * sigma_m);
  }

  MisfitRows Misfit::rows(DisplacementSource &source, const Eigen::VectorXd &unknowns, const bool derivatives) const
  {
    const Prediction prediction = predict(source, unknowns, derivatives);
    MisfitRows       result;
    result.failure = prediction.failure;
    if (!result.failure.empty())
      return result;
    const Eigen::Index    n = observed_m.size(), p = n_parameters(), k = n_components();
    const Eigen::VectorXd r   = residuals(prediction);
    result.rows               = Eigen::VectorXd::Zero(n_rows());
    result.rows.head(n)       = r.unaryExpr([this](const double residual) { return loss.root(residual); });
    result.rows.segment(n, k) = unknowns.tail(k);
    if (derivatives)
    {
      const Eigen::VectorXd slope            = -r.unaryExpr([this](const double residual) {
                                        return loss.root_slope(residual);
                                      }).cwiseQuotient(noise_scale * sigma_m);
      result.by_unknowns                     = Eigen::MatrixXd::Zero(n_rows(), n_unknowns());
      result.by_unknowns.topLeftCorner(n, p) = slope.asDiagonal() * prediction.by_x;
      result.by_unknowns.block(0, p, n, k)   = slope.asDiagonal() * prediction.by_error;
      result.by_unknowns.block(n, p, k, k).setIdentity();
    }
    for (int j = 0, row = static_cast<int>(n + k); j < map_.size(); ++j)
      if (map_.has_prior(j))
      {
        const double deviation = map_.prior_standard_deviation(j);
        result.rows[row]       = (unknowns[j] - prior_means[j]) / deviation;
        if (derivatives)
          result.by_unknowns(row, j) = 1. / deviation;
        ++row;
      }
    return result;
  }

  Eigen::VectorXd Misfit::mean_residual(const Eigen::VectorXd &unknowns, const Prediction &prediction) const
  {
    return observed_m - prediction.value_m + prediction.by_error * unknowns.tail(n_components());
  }

  Eigen::MatrixXd Misfit::covariance(const Prediction &prediction, const double at_noise_scale) const
  {
    const Eigen::VectorXd weights   = residuals(prediction).unaryExpr([&](const double r) { return loss.weight(r); });
    const Eigen::VectorXd variances = (at_noise_scale * sigma_m).cwiseAbs2().cwiseQuotient(weights);
    Eigen::MatrixXd       V         = prediction.by_error * prediction.by_error.transpose();
    V.diagonal() += variances;
    return V;
  }

  Eigen::MatrixXd Misfit::prior_information() const
  {
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n_parameters());
    for (int j = 0; j < n_parameters(); ++j)
      if (map_.has_prior(j))
        diagonal[j] = 1. / std::pow(map_.prior_standard_deviation(j), 2);
    return diagonal.asDiagonal();
  }
} // namespace swimtwin
