// The misfit as the searches of a fit see it: a function of the scaled parameters alone.
#pragma once

#include <calibration/fit/fit_input.h>
#include <calibration/misfit/misfit.h>
#include <optimization/guarded_search.h>

namespace swimtwin
{
  /// The least misfit over the components z of the model's error, at given x: variable projection (Golub and Pereyra,
  /// SIAM J. Numer. Anal. 10, 1973). Where it is least, so is the misfit in x and z together.
  class SearchMisfit
  {
  public:
    /// What `misfit` refers to must live as long.
    explicit SearchMisfit(const Misfit &misfit) : misfit_(misfit) {}

    /// x, and the components that make the misfit least for these displacements.
    Eigen::VectorXd unknowns(const Displacements &displacements, const Eigen::VectorXd &x) const;
    /// This misfit within the bounds, by displacements from `source`; this must live as long.
    MinimizationProblem minimization_problem(std::shared_ptr<DisplacementSource> source) const;

  private:
    Misfit misfit_;
  };

  /// In sigma, at least 1: of a fit with this misfit.
  double size_of_residuals(const FitInput &input, double misfit);
  /// Residuals of this size do not come from noise. What a table is off by counts as many times as they are sigmas.
  inline constexpr double far_residuals = 10.;

  /// Method, budget and seed of the problem.
  SearchOptions search_options(const CalibrationProblem &problem);
} // namespace swimtwin
