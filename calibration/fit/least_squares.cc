#include <calibration/fit/least_squares.h>

#include <unsupported/Eigen/LevenbergMarquardt>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Of a spring per unknown: a unit beyond a bound costs as much as that many standard deviations.
    constexpr double stiffness = 1e3;
    /// Relative to the unknowns' size: logarithms of about ten change by a factor of e or so.
    constexpr double largest_first_step = 0.1;

    /// What Eigen's method asks for, in the unknowns that are not held.
    class Functor : public Eigen::DenseFunctor<double>
    {
    public:
      Functor(const LeastSquaresProblem &problem, const Eigen::VectorXd &start, const std::vector<int> &free)
          : DenseFunctor(static_cast<int>(free.size()), problem.n_rows + static_cast<int>(free.size())),
            problem_(problem), free_(free), all_(start)
      {
      }

      int operator()(const Eigen::VectorXd &v, Eigen::VectorXd &rows)
      {
        if (!evaluate(v))
          return -1;
        rows = rows_;
        return 0;
      }

      int df(const Eigen::VectorXd &v, Eigen::MatrixXd &jacobian)
      {
        if (!evaluate(v))
          return -1;
        jacobian = jacobian_;
        return 0;
      }

      /// The unknowns, between their bounds.
      Eigen::VectorXd unknowns(const Eigen::VectorXd &v)
      {
        for (std::size_t i = 0; i < free_.size(); ++i)
          all_[free_[i]] = v[static_cast<Eigen::Index>(i)];
        return all_.cwiseMax(problem_.lower).cwiseMin(problem_.upper);
      }

      int n_evaluations = 0;

    private:
      bool evaluate(const Eigen::VectorXd &v)
      {
        if (v.size() == at_.size() && v == at_)
          return true;
        const Eigen::VectorXd inside = unknowns(v);
        if (!v.allFinite() || !problem_.evaluate(inside, base_, by_unknowns_) || !base_.allFinite())
          return false;
        ++n_evaluations;
        at_                                       = v;
        const Eigen::Index    n                   = problem_.n_rows;
        const Eigen::VectorXd beyond              = v - inside(free_);
        jacobian_                                 = Eigen::MatrixXd::Zero(values(), inputs());
        jacobian_.topRows(n)                      = by_unknowns_(Eigen::all, free_);
        jacobian_.bottomRows(v.size()).diagonal() = (beyond.array() != 0.).select(stiffness, beyond);
        rows_                                     = jacobian_ * beyond;
        rows_.head(n) += base_;
        return true;
      }

      const LeastSquaresProblem &problem_;
      const std::vector<int>    &free_;
      Eigen::VectorXd            all_, at_, base_, rows_;
      Eigen::MatrixXd            by_unknowns_, jacobian_;
    };

    std::vector<int> free_unknowns(const Eigen::Index n, const std::vector<int> &held)
    {
      std::vector<int> free;
      for (int j = 0; j < n; ++j)
        if (std::find(held.begin(), held.end(), j) == held.end())
          free.push_back(j);
      return free;
    }

    bool has_converged(const Eigen::LevenbergMarquardtSpace::Status status)
    {
      using namespace Eigen::LevenbergMarquardtSpace;
      return status == RelativeReductionTooSmall || status == RelativeErrorTooSmall ||
             status == RelativeErrorAndReductionTooSmall || status == CosinusTooSmall || status == FtolTooSmall ||
             status == XtolTooSmall || status == GtolTooSmall;
    }
    struct SpringSolution
    {
      LeastSquaresSolution solution;
      Eigen::VectorXd      slope; ///< of half the square, by unknown
    };

    SpringSolution solve_with_springs(const LeastSquaresProblem &problem, const Eigen::VectorXd &start,
                                      const std::vector<int> &held, const LeastSquaresOptions &options)
    {
      const std::vector<int> free = free_unknowns(start.size(), held);
      Functor                functor(problem, start, free);
      LeastSquaresSolution   solution;
      Eigen::VectorXd        v(static_cast<Eigen::Index>(free.size()));
      for (std::size_t i = 0; i < free.size(); ++i)
        v[static_cast<Eigen::Index>(i)] = start[free[i]];
      if (free.empty())
        solution.converged = true;
      else
      {
        Eigen::LevenbergMarquardt<Functor> method(functor);
        method.setFactor(largest_first_step);
        method.setFtol(options.tolerance);
        method.setXtol(options.tolerance);
        method.setMaxfev(options.max_evaluations);
        solution.converged = has_converged(method.minimize(v));
      }
      solution.unknowns = functor.unknowns(v);
      Eigen::VectorXd rows;
      Eigen::MatrixXd by_unknowns;
      if (!problem.evaluate(solution.unknowns, rows, by_unknowns))
        solution.converged = false;
      solution.half_square   = 0.5 * rows.squaredNorm();
      solution.n_evaluations = functor.n_evaluations + 1;
      return {solution, solution.converged ? Eigen::VectorXd(by_unknowns.transpose() * rows)
                                           : Eigen::VectorXd::Zero(start.size())};
    }

    /// Those that are held, and those that lie at a bound and would go on beyond it.
    std::vector<int> held_or_pushed(const LeastSquaresProblem &problem, const SpringSolution &at, std::vector<int> held)
    {
      for (const int j : free_unknowns(at.slope.size(), held))
      {
        const double x = at.solution.unknowns[j], slope = at.slope[j];
        if ((x <= problem.lower[j] && slope > 0.) || (x >= problem.upper[j] && slope < 0.))
          held.push_back(j);
      }
      return held;
    }
  } // namespace

  LeastSquaresSolution solve_least_squares(const LeastSquaresProblem &problem, const Eigen::VectorXd &start,
                                           const std::vector<int> &held, const LeastSquaresOptions &options)
  {
    SpringSolution   found         = solve_with_springs(problem, start, held, options);
    std::vector<int> held_so_far   = held;
    int              n_evaluations = found.solution.n_evaluations;
    // Large residuals stretch the springs, and the other unknowns follow the straight lines: without them, once more.
    for (Eigen::Index round = 0; round < start.size(); ++round)
    {
      const std::vector<int> pushed = held_or_pushed(problem, found, held);
      if (pushed == held_so_far)
        break;
      held_so_far = pushed;
      found       = solve_with_springs(problem, found.solution.unknowns, pushed, options);
      n_evaluations += found.solution.n_evaluations;
    }
    found.solution.n_evaluations = n_evaluations;
    return found.solution;
  }
} // namespace swimtwin
