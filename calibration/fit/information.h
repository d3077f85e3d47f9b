// What the data say about the parameters near the estimate, and what they cannot say.
#pragma once

#include <calibration/misfit/misfit.h>

namespace swimtwin
{
  /// Curvature of the misfit in the scaled parameters, the model's error accounted for.
  struct Information
  {
    Eigen::MatrixXd whitened; ///< n x p: derivatives of the predictions over their standard deviations
    Eigen::VectorXd residual; ///< n: observed - predicted without the model's fitted error, likewise
    Eigen::MatrixXd prior;    ///< p x p, of the priors alone

    Eigen::VectorXd singular_values; ///< of `whitened`, largest first
    Eigen::MatrixXd null_directions; ///< orthonormal columns: no data see them
    Eigen::MatrixXd undecided;       ///< those among their span that no prior decides
    Eigen::MatrixXd covariance;      ///< p x p; across the undecided directions, as if those were held

    int  n_parameters() const { return static_cast<int>(whitened.cols()); }
    bool touches_undecided(int parameter) const;
    /// Standard deviation of a combination of the scaled parameters; infinite if an undecided direction changes it.
    double standard_deviation(const Eigen::VectorXd &combination) const;
  };

  /// A direction is null if its singular value is this small beside the largest: what exact sensitivities leave of
  /// zero lies orders below, what data can use at all orders above.
  inline constexpr double null_strength = 1e-5;

  /// `prediction` with derivatives, at the estimate.
  Information information(const Misfit &misfit, const Eigen::VectorXd &unknowns, const Prediction &prediction);
} // namespace swimtwin
