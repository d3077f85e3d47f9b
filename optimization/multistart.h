// Many local searches from many starts.
#pragma once

#include <optimization/guarded_search.h>
#include <optimization/sobol_points.h>

namespace swimtwin
{
  struct Multistart
  {
    std::vector<Minimum> minima;    ///< in the order of the starts, the same for any number of threads
    int                  best = -1; ///< the lowest feasible one, converged before others; -1: none is feasible

    bool found() const { return best >= 0 && minima[best].converged(); }
  };

  struct MultistartOptions
  {
    SearchOptions                   search;
    int                             n_threads   = 0;  ///< 0: as many as the machine has
    std::function<void(int n_done)> on_progress = {}; ///< called by any of the threads, one at a time
  };

  /// The lowest feasible one, converged before others; -1 if none is feasible.
  int best_minimum(const std::vector<Minimum> &minima);

  /// One search per column of `starts`, for instance sobol_points. `make_problem` is called once per thread, by that
  /// thread.
  Multistart search_from_all(const std::function<MinimizationProblem()> &make_problem, const Eigen::MatrixXd &starts,
                             const MultistartOptions &options = {});
} // namespace swimtwin
