#include <optimization/nlopt_run.h>

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <exception>

namespace swimtwin
{
  namespace
  {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    nlopt::algorithm algorithm(const SearchMethod method)
    {
      switch (method)
      {
      case SearchMethod::mma:
        return nlopt::LD_MMA;
      case SearchMethod::ccsaq:
        return nlopt::LD_CCSAQ;
      case SearchMethod::slsqp:
        return nlopt::LD_SLSQP;
      case SearchMethod::lbfgs:
        return nlopt::LD_LBFGS;
      case SearchMethod::cobyla:
        return nlopt::LN_COBYLA;
      case SearchMethod::bobyqa:
        return nlopt::LN_BOBYQA;
      case SearchMethod::sbplx:
        return nlopt::LN_SBPLX;
      case SearchMethod::nelder_mead:
        return nlopt::LN_NELDERMEAD;
      case SearchMethod::isres:
        break;
      }
      return nlopt::GN_ISRES;
    }

    /// What NLopt's callbacks work on. An exception of the problem is kept here while NLopt is brought to its end.
    struct Callbacks
    {
      const MinimizationProblem &problem;
      const Scales              &scales;
      SearchRecord              &record;
      std::exception_ptr         error;

      const SearchPoint &evaluate(const double *z, const unsigned n, const bool derivatives)
      {
        const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(z, n)
                                      .cwiseProduct(scales.variables)
                                      .cwiseMax(problem.lower)
                                      .cwiseMin(problem.upper);
        try
        {
          return record.evaluate(x, derivatives);
        }
        catch (...) // not to steer: thrown again when NLopt has returned
        {
          error = std::current_exception();
          throw nlopt::forced_stop();
        }
      }
    };

    double objective(const unsigned n, const double *z, double *gradient, void *data)
    {
      auto &callbacks = *static_cast<Callbacks *>(data);
      // NLopt asks for a point's objective first and for its constraints then, so that this is where a budget ends.
      if (callbacks.record.is_spent())
        throw nlopt::forced_stop();
      const SearchPoint &point  = callbacks.evaluate(z, n, gradient != nullptr);
      const bool         failed = point.evaluation.failed();
      if (gradient != nullptr)
        Eigen::Map<Eigen::VectorXd>(gradient, n) =
            failed ? Eigen::VectorXd::Zero(n).eval() : scaled(point.evaluation, callbacks.scales).gradient;
      return failed ? HUGE_VAL : point.evaluation.objective / callbacks.scales.objective;
    }

    void constraints(const unsigned m, double *values, const unsigned n, const double *z, double *jacobian, void *data)
    {
      auto              &callbacks = *static_cast<Callbacks *>(data);
      const SearchPoint &point     = callbacks.evaluate(z, n, jacobian != nullptr);
      const bool         failed    = point.evaluation.failed();
      Eigen::Map<Eigen::VectorXd>(values, m) =
          failed ? Eigen::VectorXd::Ones(m).eval()
                 : point.evaluation.constraints.cwiseQuotient(callbacks.scales.constraints).eval();
      if (jacobian != nullptr)
        Eigen::Map<RowMajor>(jacobian, m, n) =
            failed ? Eigen::MatrixXd::Zero(m, n).eval() : scaled(point.evaluation, callbacks.scales).jacobian;
    }

    std::vector<double> to_nlopt(const Eigen::VectorXd &x, const Scales &scales)
    {
      std::vector<double> z(x.size());
      Eigen::Map<Eigen::VectorXd>(z.data(), x.size()) = x.cwiseQuotient(scales.variables);
      return z;
    }
  } // namespace

  void run_nlopt(const MinimizationProblem &problem, const Scales &scales, const Eigen::VectorXd &start,
                 const SearchOptions &options, SearchRecord &record)
  {
    Callbacks  callbacks{problem, scales, record, {}};
    nlopt::opt search(algorithm(options.method), static_cast<unsigned>(problem.n_variables()));
    search.set_lower_bounds(to_nlopt(problem.lower, scales));
    search.set_upper_bounds(to_nlopt(problem.upper, scales));
    search.set_min_objective(objective, &callbacks);
    if (problem.n_constraints > 0)
      search.add_inequality_mconstraint(constraints, &callbacks, std::vector<double>(problem.n_constraints, 0.));
    search.set_xtol_abs(options.step_tolerance);
    search.set_initial_step(1.);
    nlopt::srand(options.seed);

    std::vector<double> z     = to_nlopt(start, scales);
    double              found = 0.;
    try
    {
      search.optimize(z, found);
    }
    catch (const nlopt::forced_stop &)
    {
    }
    catch (const nlopt::roundoff_limited &)
    {
    }
    catch (const std::runtime_error &) // "nlopt failure": judged like any other end
    {
    }
    if (callbacks.error)
      std::rethrow_exception(callbacks.error);
  }
} // namespace swimtwin
