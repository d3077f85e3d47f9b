#include <control/closed_loop.h>
#include <control/course_terms.h>
#include <control/target_search.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    class TargetProblem
    {
    public:
      TargetProblem(const ReducedSwimmer &swimmer, const RunRequest &request, const Eigen::Vector2d &target_m,
                    const int n_periods, const TargetOptions &options)
          : request_(request), term_(target_m, options.distance * swimmer.length_m()), n_periods_(n_periods),
            options_(options), adjoint_(swimmer, {.max_step_periods = IntegratorOptions().max_step_periods / n_periods})
      {
        plan_.carrier      = request.drive;
        plan_.knot_periods = options.knot_periods;
        plan_.angles_rad =
            Eigen::VectorXd::Zero(static_cast<Eigen::Index>(std::ceil(n_periods / options.knot_periods)) + 3);
      }

      SteeringPlan plan(const Eigen::VectorXd &x) const
      {
        SteeringPlan plan         = plan_;
        plan.carrier.frequency_Hz = request_.drive.frequency_Hz * std::exp(x[0]);
        double angle              = 0.;
        for (Eigen::Index k = 1; k < x.size(); ++k)
          plan.angles_rad[k - 1] = angle += x[k];
        return plan;
      }

      /// Log of the time, and the distance's constraint.
      void evaluate(const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation)
      {
        request_.drive     = window_of(plan(x), 0., n_periods_);
        request_.n_periods = 1;
        const MotionGradient gradient =
            derivatives ? adjoint_.differentiate(request_, term_) : adjoint_.evaluate(request_, term_);
        request_.drive     = plan_.carrier;
        evaluation.failure = gradient.failure;
        if (!gradient.completed())
          return;
        evaluation.objective   = -x[0];
        evaluation.constraints = Eigen::VectorXd::Constant(1, compressed(gradient.value));
        if (derivatives)
          set_derivatives(x, gradient, evaluation);
      }

      MinimizationProblem problem()
      {
        const Eigen::Index  n = 1 + plan_.angles_rad.size();
        MinimizationProblem problem;
        problem.lower            = Eigen::VectorXd::Constant(n, -options_.max_turn_rad);
        problem.upper            = -problem.lower;
        problem.lower[0]         = std::log(options_.frequency_Hz.low / plan_.carrier.frequency_Hz);
        problem.upper[0]         = std::log(options_.frequency_Hz.high / plan_.carrier.frequency_Hz);
        problem.scale            = Eigen::VectorXd::Constant(n, 0.1);
        problem.n_constraints    = 1;
        problem.constraint_names = {"distance from the target"};
        problem.evaluate         = [this](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
          evaluate(x, derivatives, evaluation);
        };
        return problem;
      }

      Eigen::Vector2d end_m() const { return adjoint_.motion().end().head<2>(); }

    private:
      /// Squared distances per squared tolerance span orders of magnitude: their logarithm is at most 0 where they are
      /// at most 1.
      static double compressed(const double squares) { return std::log(squares + 1e-3) - std::log(1. + 1e-3); }

      void set_derivatives(const Eigen::VectorXd &x, const MotionGradient &gradient, Evaluation &evaluation) const
      {
        const double slope     = 1. / (gradient.value + 1e-3);
        evaluation.gradient    = Eigen::VectorXd::Zero(x.size());
        evaluation.gradient[0] = -1.;
        evaluation.jacobian.resize(1, x.size());
        const double frequency    = request_.drive.frequency_Hz * std::exp(x[0]) / n_periods_; // of the window
        evaluation.jacobian(0, 0) = slope * gradient.by_frequency * frequency;
        double so_far             = 0.; // a change of the angle moves all later coefficients
        for (Eigen::Index k = x.size() - 1; k > 0; --k)
          evaluation.jacobian(0, k) =
              slope * (so_far += k - 1 < gradient.by_field.size() ? gradient.by_field[k - 1] : 0.);
      }

      RunRequest        request_;
      TargetTerm        term_;
      int               n_periods_;
      TargetOptions     options_;
      AdjointIntegrator adjoint_;
      SteeringPlan      plan_;
    };

    /// The turn towards the target, as fast as allowed.
    Eigen::VectorXd first_guess(const SwimmerState &start, const Eigen::Vector2d &target_m, const Eigen::Index n,
                                const double max_turn_rad)
    {
      const Eigen::Vector2d way  = target_m - start.head<2>();
      double                turn = std::remainder(std::atan2(-way.y(), -way.x()), 2. * std::numbers::pi);
      Eigen::VectorXd       x    = Eigen::VectorXd::Zero(n);
      for (Eigen::Index k = 1; k < n; ++k)
      {
        x[k] = std::clamp(turn, -0.9 * max_turn_rad, 0.9 * max_turn_rad);
        turn -= x[k];
      }
      return x;
    }

    std::vector<int> periods_to_try(const TargetOptions &options, const double distance_m, const double advance_m)
    {
      if (!options.periods.empty())
        return options.periods;
      std::vector<int> periods;
      for (const double share : {0.8, 1., 1.25})
        periods.push_back(std::max(2, static_cast<int>(std::lround(share * distance_m / advance_m))));
      return periods;
    }
  } // namespace

  TargetWay fastest_way(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Drive &carrier,
                        const SwimmerState &start, const Eigen::Vector2d &target_m, const TargetOptions &options)
  {
    const double     distance = (target_m - start.head<2>()).norm();
    const RunRequest request{parameters, carrier, start, 1, 0};
    TargetWay        best;
    for (const int n : periods_to_try(options, distance, carrier_motion(swimmer, parameters, carrier).advance_m))
    {
      TargetProblem             target(swimmer, request, target_m, n, options);
      const MinimizationProblem problem = target.problem();
      const Minimum             minimum = search_minimum(
                      problem, first_guess(start, target_m, problem.n_variables(), options.max_turn_rad), options.search);
      if (minimum.x.size() == 0)
        continue;
      TargetWay way{minimum, target.plan(minimum.x), n};
      way.time_s = n / way.plan.carrier.frequency_Hz;
      Evaluation last;
      target.evaluate(minimum.x, false, last);
      way.end_m         = target.end_m();
      const bool better = best.n_periods == 0 || (way.found() && (!best.found() || way.time_s < best.time_s)) ||
                          (!best.found() && way.minimum.violation < best.minimum.violation);
      if (better)
        best = std::move(way);
    }
    return best;
  }
} // namespace swimtwin
