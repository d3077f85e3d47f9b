// The fit once more near the estimate: with other data, or with one parameter held. Fast, on the estimate's table.
#pragma once

#include <calibration/fit/fit.h>

namespace swimtwin
{
  /// One thread's own.
  class Refit
  {
  public:
    Refit(const FitInput &input, const Estimate &estimate);

    /// Least misfit with parameter j held at x_j (scaled), from the unknowns of the last answer if `warm`.
    LeastSquaresSolution with_held(int j, double x_j, bool warm);
    /// With these observations (m) and prior means in place of the real ones.
    LeastSquaresSolution with_data(const Eigen::VectorXd &observed_m, const Eigen::VectorXd &prior_means);

    /// Whether the table still holds the swimmer of these unknowns.
    bool covers(const Eigen::VectorXd &unknowns) const;
    /// Predictions at unknowns (m).
    Eigen::VectorXd predictions(const Eigen::VectorXd &unknowns);

  private:
    LeastSquaresSolution solve(const Eigen::VectorXd &start, const std::vector<int> &held);

    const FitInput                    &input_;
    const Estimate                    &estimate_;
    std::unique_ptr<DisplacementTable> table_;
    Misfit                             misfit_;
    Eigen::VectorXd                    last_;
  };
} // namespace swimtwin
