// The reduced model's own error, as a random factor that is smooth in frequency.
#pragma once

#include <calibration/misfit/calibration_data.h>
#include <datasets/reduced/reduced_model.h>

namespace swimtwin
{
  /// The full-order displacement is the reduced one times 1 + e, with e normal of mean 0 and
  ///   cov(e_i, e_j) = s_i s_j (1/2 + 1/2 exp(-(log10(f_i / f_j) / decades)^2 / 2)):
  /// one half common to all observations, one half that forgets over some decades of frequency. Held-out runs show
  /// both: a common sign, and a drift from low to high frequencies.
  struct ModelError
  {
    double          relative_size = 0.; ///< of the held-out runs, or given
    double          decades       = 0.5;
    std::string     origin        = "none"; ///< "held-out runs", "given", "none"
    Eigen::VectorXd size;                   ///< s_i, one per observation
    Eigen::MatrixXd factor;                 ///< n x k: e = factor z with z standard normal; k = 0: no error

    int n_components() const { return static_cast<int>(factor.cols()); }
  };

  /// Largest error indicator over displacement among the runs that the model was not trained on; 0 without any.
  double held_out_indicator(const TrainingRecord &record);

  /// `growth`: how many times larger than in held-out runs the error is at each observation, at least 1.
  ModelError model_error(const TrainingRecord &record, const std::optional<double> &given, const CalibrationData &data,
                         const Eigen::VectorXd &growth);
} // namespace swimtwin
