// What the estimate predicts at other frequencies, and where one more observation would help most.
#pragma once

#include <calibration/uncertainty/intervals.h>

namespace swimtwin
{
  /// Predicted displacements of every data set over a range of frequencies, with derivatives.
  struct Forecast
  {
    struct Curve
    {
      int             set = 0;
      Eigen::VectorXd frequency_Hz, value_m;
      Eigen::MatrixXd by_x;                   ///< n x parameters
      Eigen::VectorXd noise_m, model_error_m; ///< standard deviations of one observation
    };
    std::vector<Curve> curves;
    long               n_runs = 0;
  };

  /// Frequencies are spread evenly in their logarithm between the problem's limits, or those of the data. A set whose
  /// swimmer cannot be computed at one of them is left out.
  Forecast forecast(const FitInput &input, const Estimate &estimate, const std::vector<ObservationSet> &sets,
                    int n_frequencies);

  PredictionBand prediction_band(const FitInput &input, const Estimate &estimate, const Forecast::Curve &curve,
                                 double factor);

  /// The best of all data sets. An observation adds j j^T / v to the information, with the derivatives j of its
  /// prediction and the variance v of noise and model error: the chosen parameter's variance c = C_kk falls to
  /// c - (C j)_k^2 / (v + j^T C j), and the information's log-determinant grows by log(1 + j^T C j / v). Nothing for a
  /// parameter that is undetermined.
  std::optional<NextExperiment> next_experiment(const FitInput &input, const Estimate &estimate,
                                                const Forecast &forecast, int parameter);
} // namespace swimtwin
