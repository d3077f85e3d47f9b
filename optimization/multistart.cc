#include <datasets/system/parallel_for.h>
#include <optimization/multistart.h>

#include <mutex>
#include <utility>

namespace swimtwin
{
  namespace
  {
    bool is_better(const Minimum &one, const Minimum &other)
    {
      return std::pair(!one.converged(), one.objective) < std::pair(!other.converged(), other.objective);
    }
  } // namespace

  int best_minimum(const std::vector<Minimum> &minima)
  {
    int best = -1;
    for (int i = 0; i < static_cast<int>(minima.size()); ++i)
      if (minima[i].is_feasible() && (best < 0 || is_better(minima[i], minima[best])))
        best = i;
    return best;
  }

  Multistart search_from_all(const std::function<MinimizationProblem()> &make_problem, const Eigen::MatrixXd &starts,
                             const MultistartOptions &options)
  {
    Multistart result;
    const auto n = static_cast<std::size_t>(starts.cols());
    result.minima.resize(n);
    std::mutex reporting;
    int        n_done = 0;
    parallel_for(n, n_threads_for(n, options.n_threads), [&] {
      return [&, problem = make_problem()](const std::size_t i) {
        result.minima[i] = search_minimum(problem, starts.col(static_cast<Eigen::Index>(i)), options.search);
        const std::lock_guard lock(reporting);
        ++n_done;
        if (options.on_progress)
          options.on_progress(n_done);
      };
    });
    result.best = best_minimum(result.minima);
    return result;
  }
} // namespace swimtwin
