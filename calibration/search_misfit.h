// The misfit as the searches of a fit see it, without unknowns beside the parameters.
#pragma once

#include <calibration/fit_input.h>
#include <calibration/misfit.h>
#include <optimization/guarded_search.h>

namespace swimtwin
{
  /// The model's error only makes observations less sure, each by itself.
  class SearchMisfit
  {
  public:
    SearchMisfit(const FitInput &input, const ModelError &error);
    SearchMisfit(const SearchMisfit &)            = delete;
    SearchMisfit &operator=(const SearchMisfit &) = delete;

    /// This misfit within the bounds, by displacements from `source`; this must live as long.
    MinimizationProblem minimization_problem(std::shared_ptr<DisplacementSource> source) const;

  private:
    ModelError none_;
    Misfit     misfit_;
  };

  /// Method, budget and seed of the problem.
  SearchOptions search_options(const CalibrationProblem &problem);
} // namespace swimtwin
