// The search of a fit's bounds: from many starts, on one table that holds all of them.
#pragma once

#include <calibration/fit/fit_input.h>
#include <calibration/misfit/model_error.h>
#include <datasets/observation/calibration_result.h>
#include <optimization/multistart.h>

#include <vector>

namespace swimtwin
{
  struct BoundsSearch : Multistart
  {
    Eigen::MatrixXd                    starts; ///< p x n, scaled
    std::shared_ptr<DisplacementTable> table;  ///< of the bounds, as far as they can be computed; or null
    long                               n_runs = 0;
  };

  /// From the problem's own start, or the nominal swimmer, and from points that fill the bounds. Without a table by
  /// exact displacements. Throws InputError if no start could be computed.
  BoundsSearch search_bounds(const FitInput &input, const ModelError &error);
  /// On the table of an earlier search, with another error of the model.
  BoundsSearch search_again(const FitInput &input, const ModelError &error, const BoundsSearch &earlier);

  /// Whether two minima are one, found twice. `width` is that of the bounds.
  bool are_same(const Eigen::VectorXd &a, const Eigen::VectorXd &b, const Eigen::VectorXd &width);
  /// Minima that may be the best one: those that are not the same one again, of about the best one's misfit, best
  /// first, few.
  std::vector<Eigen::VectorXd> distinct_minima(const Multistart &search, const Eigen::VectorXd &width);

  /// Start by start, best first.
  std::vector<FitStart> waterfall(const FitInput &input, const BoundsSearch &search);
} // namespace swimtwin
