// The estimate: many searches on a table of displacements, the best of them again with exact ones, a polish.
#pragma once

#include <calibration/fit/bounds_search.h>
#include <calibration/fit/information.h>
#include <calibration/fit/least_squares.h>

#include <memory>

namespace swimtwin
{
  struct Estimate
  {
    Eigen::VectorXd unknowns; ///< scaled parameters, then components of the model's error
    ModelError      error;
    double          noise_scale = 1.;

    BoundsSearch search;              ///< of all bounds
    Minimum      refined;             ///< the best one, on a table around the estimate
    bool         polished    = false; ///< exact displacements and sensitivities see the minimum there, too
    double       polish_step = 0.;    ///< by which they would still move a scaled parameter
    double       misfit      = 0.;
    /// Largest cosine between the rows and a column of derivatives that no bound holds: zero at a minimum.
    double kkt_residual         = 0.;
    double integrator_tolerance = 0.;
    long   n_runs               = 0;

    std::shared_ptr<DisplacementTable> local; ///< around the estimate

    Information information;
    Prediction  prediction; ///< with derivatives

    Eigen::VectorXd x() const { return unknowns.head(information.n_parameters()); }
  };

  /// Throws InputError if no start could be computed.
  Estimate fit(const FitInput &input);

  /// The minimum near a start on a table that is there already, for many data sets observed under the same conditions:
  /// neither a search of the bounds nor exact displacements. The table must reach far enough.
  Estimate fit_near(const FitInput &input, const std::shared_ptr<DisplacementTable> &table, const Eigen::VectorXd &x);

  /// The misfit of an estimate: its model error and noise level.
  Misfit misfit_of(const FitInput &input, const Estimate &estimate);
  /// Least squares for a misfit, in its unknowns; `source` and `misfit` must live as long. The components of the
  /// model's error are free.
  LeastSquaresProblem least_squares_problem(const Misfit &misfit, DisplacementSource &source);
} // namespace swimtwin
