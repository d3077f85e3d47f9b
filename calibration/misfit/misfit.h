// What a fit makes small: residuals through the loss, the model's error and priors held at their size.
#pragma once

#include <calibration/misfit/model_error.h>
#include <calibration/misfit/parameter_map.h>
#include <calibration/misfit/robust_loss.h>

namespace swimtwin
{
  /// Recorded displacements as the fit sees them (docs/equations.md, section 16).
  struct Prediction
  {
    Eigen::VectorXd value_m;  ///< offset + scale x geometry scale x displacement x (1 + e)
    Eigen::MatrixXd by_x;     ///< n x parameters
    Eigen::MatrixXd by_error; ///< n x components of the model's error
    std::string     failure;
  };

  /// Unknowns u = (x, z): scaled parameters, then components of the model's error. The misfit is half the square of
  /// `rows`: one per observation (the root of its loss), one per component, one per prior.
  struct MisfitRows
  {
    Eigen::VectorXd rows;
    Eigen::MatrixXd by_unknowns;
    std::string     failure;

    double misfit() const { return 0.5 * rows.squaredNorm(); }
  };

  class Misfit
  {
  public:
    Misfit(const CalibrationData &data, const ParameterMap &map, const ModelError &error, const RobustLoss &own_loss)
        : observed_m(data.observed_m), sigma_m(data.sigma_m), loss(own_loss), map_(map), error_(error)
    {
      prior_means = map.nominal();
      for (int j = 0; j < map.size(); ++j)
        if (map.has_prior(j))
          prior_means[j] = map.prior_mean(j);
    }

    int n_parameters() const { return map_.size(); }
    int n_components() const { return error_.n_components(); }
    int n_unknowns() const { return n_parameters() + n_components(); }
    int n_rows() const;

    const ParameterMap &map() const { return map_; }
    const ModelError   &error() const { return error_; }

    Prediction predict(DisplacementSource &source, const Eigen::VectorXd &unknowns, bool derivatives) const;
    MisfitRows rows(DisplacementSource &source, const Eigen::VectorXd &unknowns, bool derivatives) const;
    /// Residuals (observed - predicted) / (noise scale x sigma).
    Eigen::VectorXd residuals(const Prediction &prediction) const;
    /// Observed less predicted with the model's error at its mean (m).
    Eigen::VectorXd mean_residual(const Eigen::VectorXd &unknowns, const Prediction &prediction) const;
    /// Of the observations (m^2): noise at this scale, less sure where the loss gives less weight, and the model's
    /// error.
    Eigen::MatrixXd covariance(const Prediction &prediction, double at_noise_scale) const;
    /// Curvature of the priors, p x p.
    Eigen::MatrixXd prior_information() const;

    Eigen::VectorXd observed_m, sigma_m;
    double          noise_scale = 1.;
    RobustLoss      loss;
    Eigen::VectorXd prior_means; ///< of x; those without a prior do not matter

  private:
    const ParameterMap &map_;
    const ModelError   &error_;
  };
} // namespace swimtwin
