// Many local searches from points that fill the bounds evenly.
#pragma once

#include <optimization/guarded_search.h>

namespace swimtwin
{
  /// Sobol points between the bounds, one per column, shifted at random (modulo the box) by the seed; seed 0: as they
  /// are.
  Eigen::MatrixXd sobol_points(const Eigen::VectorXd &lower, const Eigen::VectorXd &upper, int n_points,
                               unsigned long seed);

  struct Multistart
  {
    std::vector<Minimum> minima;    ///< in the order of the starts, which makes them the same for any number of threads
    int                  best = -1; ///< the lowest feasible one, converged before others; -1: none is feasible

    bool found() const { return best >= 0 && minima[best].converged(); }
  };

  struct MultistartOptions
  {
    SearchOptions                   search;
    int                             n_threads   = 0;  ///< 0: as many as the machine has
    std::function<void(int n_done)> on_progress = {}; ///< called by any of the threads, one at a time
  };

  /// `make_problem` is called once per thread, by that thread.
  Multistart search_from_all(const std::function<MinimizationProblem()> &make_problem, const Eigen::MatrixXd &starts,
                             const MultistartOptions &options = {});
} // namespace swimtwin
