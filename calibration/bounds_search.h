// The search of a fit's bounds: from many starts, on one table that holds all of them.
#pragma once

#include <calibration/fit_input.h>
#include <calibration/model_error.h>
#include <datasets/calibration_result.h>
#include <optimization/multistart.h>

#include <vector>

namespace swimtwin
{
  struct BoundsSearch : Multistart
  {
    Eigen::MatrixXd starts;           ///< p x n, scaled
    double          table_error = 0.; ///< of the table, see DisplacementTable; 0 if the search had none
    long            n_runs      = 0;
  };

  /// From the problem's own start, or the nominal swimmer, and from points that fill the bounds. Without a table, if a
  /// node of it cannot be computed, by exact displacements. Throws InputError if no start could be computed.
  BoundsSearch search_bounds(const FitInput &input, const ModelError &error);

  /// Minima that may be the best one: those that are not the same one again, of about the best one's misfit, best
  /// first, few. `width` is that of the bounds.
  std::vector<Eigen::VectorXd> distinct_minima(const Multistart &search, const Eigen::VectorXd &width);

  /// Start by start, best first.
  std::vector<FitStart> waterfall(const FitInput &input, const BoundsSearch &search);
} // namespace swimtwin
