#include <control/steering/course_terms.h>
#include <control/steering/target_search.h>
#include <datasets/system/error.h>
#include <rom/sensitivity/periodic_orbit.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    /// The end lies in a square inside the disc about the target, with two sides along the straight way: where a swim
    /// ends changes nearly linearly with steering and frequency.
    class TargetProblem
    {
    public:
      TargetProblem(const ReducedSwimmer &swimmer, const RunRequest &request, const Eigen::Vector2d &target_m,
                    const int n_periods, const TargetOptions &options)
          : request_(request), offsets_(offsets(request, target_m, options.distance * swimmer.length_m())),
            n_periods_(n_periods), options_(options),
            adjoint_(swimmer,
                     {.relative_tolerance = 1e-7, .max_step_periods = IntegratorOptions().max_step_periods / n_periods})
      {
        plan_.carrier      = request.drive;
        plan_.knot_periods = options.knot_periods;
        plan_.angles_rad   = Eigen::VectorXd::Constant(
              static_cast<Eigen::Index>(std::ceil(n_periods / options.knot_periods)) + 3, request.initial_state[2]);
      }

      SteeringPlan plan(const Eigen::VectorXd &x) const
      {
        SteeringPlan plan         = plan_;
        plan.carrier.frequency_Hz = request_.drive.frequency_Hz * std::exp(x[0]);
        double angle              = request_.initial_state[2];
        for (Eigen::Index k = 1; k < x.size(); ++k)
          plan.angles_rad[k - 1] = angle += x[k];
        return plan;
      }

      /// Log of the time, and the end's offsets from the target.
      void evaluate(const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation)
      {
        request_.drive         = window_of(plan(x), 0., n_periods_);
        request_.n_periods     = 1;
        evaluation.objective   = -x[0];
        evaluation.gradient    = -Eigen::VectorXd::Unit(x.size(), 0);
        evaluation.constraints = Eigen::VectorXd(n_bounds);
        evaluation.jacobian    = Eigen::MatrixXd(n_bounds, x.size());
        for (Eigen::Index i = 0; i < 2 && !evaluation.failed(); ++i)
          if (i == 0 || derivatives)
            bound_offset(i, x, derivatives, evaluation);
          else // the run is known
            set_bounds(i, offsets_[1].terminal(adjoint_.motion().end()), evaluation);
        request_.drive = plan_.carrier;
      }

      MinimizationProblem problem()
      {
        const Eigen::Index  n = 1 + plan_.angles_rad.size();
        MinimizationProblem problem;
        problem.lower            = Eigen::VectorXd::Constant(n, -options_.max_turn_rad);
        problem.upper            = -problem.lower;
        problem.lower[0]         = std::log(lowest_frequency_Hz() / plan_.carrier.frequency_Hz);
        problem.upper[0]         = std::log(options_.frequency_Hz.high / plan_.carrier.frequency_Hz);
        problem.scale            = Eigen::VectorXd::Constant(n, 0.1);
        problem.n_constraints    = n_bounds;
        problem.constraint_names = {"distance from the target (beyond it)", "distance from the target (short of it)",
                                    "distance from the target (on its left)",
                                    "distance from the target (on its right)"};
        problem.evaluate         = [this](const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation) {
          evaluate(x, derivatives, evaluation);
        };
        return problem;
      }

      /// Slower, the last period would end too late.
      double lowest_frequency_Hz() const
      {
        return std::max(options_.frequency_Hz.low, n_periods_ / options_.time_limit_s);
      }
      bool has_time() const { return lowest_frequency_Hz() <= options_.frequency_Hz.high; }

      Eigen::Vector2d end_m() const { return adjoint_.motion().end().head<2>(); }

    private:
      static constexpr Eigen::Index n_bounds = 4;

      static std::array<OffsetTerm, 2> offsets(const RunRequest &request, const Eigen::Vector2d &target_m,
                                               const double distance_m)
      {
        const Eigen::Vector2d along = (target_m - request.initial_state.head<2>()).normalized();
        const double          half  = distance_m / std::numbers::sqrt2; // of the square's side
        return {OffsetTerm(target_m, along, half), OffsetTerm(target_m, {-along.y(), along.x()}, half)};
      }

      static void set_bounds(const Eigen::Index i, const double offset, Evaluation &evaluation)
      {
        evaluation.constraints.segment<2>(2 * i) << offset - 1., -offset - 1.;
      }

      void bound_offset(const Eigen::Index i, const Eigen::VectorXd &x, const bool derivatives, Evaluation &evaluation)
      {
        const OffsetTerm    &offset = offsets_[static_cast<std::size_t>(i)];
        const MotionGradient found =
            derivatives ? adjoint_.differentiate(request_, offset) : adjoint_.evaluate(request_, offset);
        evaluation.failure = found.failure;
        if (!found.completed())
          return;
        set_bounds(i, found.value, evaluation);
        if (!derivatives)
          return;
        const Eigen::RowVectorXd slopes    = this->slopes(x, found);
        evaluation.jacobian.row(2 * i)     = slopes;
        evaluation.jacobian.row(2 * i + 1) = -slopes;
      }

      Eigen::RowVectorXd slopes(const Eigen::VectorXd &x, const MotionGradient &found) const
      {
        Eigen::RowVectorXd slopes(x.size());
        slopes[0]     = found.by_frequency * request_.drive.frequency_Hz; // of the window
        double so_far = 0.;                                               // a change of the angle moves all later ones
        for (Eigen::Index k = x.size() - 1; k > 0; --k)
          slopes[k] = so_far += k - 1 < found.by_field.size() ? found.by_field[k - 1] : 0.;
        return slopes;
      }

      RunRequest                request_;
      std::array<OffsetTerm, 2> offsets_;
      int                       n_periods_;
      TargetOptions             options_;
      AdjointIntegrator         adjoint_;
      SteeringPlan              plan_;
    };

    /// The turn towards the target, as fast as allowed, at the frequency of the fastest swim.
    Eigen::VectorXd first_guess(const SwimmerState &start, const Eigen::Vector2d &target_m, const Eigen::Index n,
                                const double frequency_ratio, const double max_turn_rad)
    {
      double          turn = turn_towards(target_m, start);
      Eigen::VectorXd x    = Eigen::VectorXd::Zero(n);
      x[0]                 = std::log(frequency_ratio);
      for (Eigen::Index k = 1; k < n; ++k)
      {
        x[k] = std::clamp(turn, -0.9 * max_turn_rad, 0.9 * max_turn_rad);
        turn -= x[k];
      }
      return x;
    }

    /// What a straight way needs, and turns on top of it; later ones are for where these do not suffice.
    std::vector<int> periods_to_try(const TargetOptions &options, const double straight, const double turning)
    {
      if (!options.periods.empty())
        return options.periods;
      std::vector<int> periods;
      for (const double n : {straight, straight + 0.5 * turning, straight + turning, 1.15 * straight + turning,
                             1.5 * straight + 1.5 * turning, 2. * straight + 2. * turning})
        if (const int whole = std::max(2, static_cast<int>(std::ceil(n))); periods.empty() || whole > periods.back())
          periods.push_back(whole);
      return periods;
    }

    bool is_better(const TargetWay &way, const TargetWay &best)
    {
      if (best.n_periods == 0 || way.found() != best.found())
        return best.n_periods == 0 || way.found();
      return way.found() ? way.time_s < best.time_s : way.minimum.violation < best.minimum.violation;
    }
  } // namespace

  double turn_towards(const Eigen::Vector2d &target_m, const SwimmerState &start)
  {
    const Eigen::Vector2d way = target_m - start.head<2>();
    return std::remainder(std::atan2(-way.y(), -way.x()) - start[2], 2. * std::numbers::pi);
  }

  StraightSwim fastest_straight_swim(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, Drive carrier,
                                     const Interval &frequency_Hz)
  {
    constexpr int       n_frequencies = 24;
    PeriodicOrbitFinder orbits(swimmer);
    StraightSwim        best;
    const double        ratio = frequency_Hz.high / frequency_Hz.low;
    for (int i = 0; i < n_frequencies; ++i)
    {
      carrier.frequency_Hz      = frequency_Hz.low * std::pow(ratio, static_cast<double>(i) / (n_frequencies - 1));
      const PeriodicOrbit orbit = orbits.find({parameters, carrier, state_at_rest(swimmer), 1, 0});
      if (!orbit.converged() || !orbit.is_stable())
        continue;
      if (const double advance = orbit.displacement_m(0.); advance * carrier.frequency_Hz > best.speed_m_s())
        best = {carrier.frequency_Hz, advance};
    }
    if (best.frequency_Hz <= 0.)
      throw ComputationError(fmt::format("the carrier swims head first at no frequency from {:.4g} to {:.4g} Hz",
                                         frequency_Hz.low, frequency_Hz.high));
    return best;
  }

  TargetWay fastest_way(const ReducedSwimmer &swimmer, const SwimmerParameters &parameters, const Drive &carrier,
                        const SwimmerState &start, const Eigen::Vector2d &target_m, const TargetOptions &options)
  {
    const StraightSwim swim     = fastest_straight_swim(swimmer, parameters, carrier, options.frequency_Hz);
    const double       distance = (target_m - start.head<2>()).norm() - options.distance * swimmer.length_m();
    const double       turning  = std::abs(turn_towards(target_m, start)) / options.max_turn_rad * options.knot_periods;
    const RunRequest   request{parameters, carrier, start, 1, 0};
    TargetWay          best;
    for (const int n : periods_to_try(options, distance / swim.advance_m, turning))
    {
      TargetProblem target(swimmer, request, target_m, n, options);
      if (!target.has_time())
        break;
      const MinimizationProblem problem = target.problem();
      const Minimum             minimum =
          search_minimum(problem,
                         first_guess(start, target_m, problem.n_variables(), swim.frequency_Hz / carrier.frequency_Hz,
                                     options.max_turn_rad),
                         options.search);
      if (minimum.x.size() == 0)
        continue;
      TargetWay way{minimum, target.plan(minimum.x), n};
      way.time_s = n / way.plan.carrier.frequency_Hz;
      Evaluation last;
      target.evaluate(minimum.x, false, last);
      way.end_m         = target.end_m();
      const bool longer = best.found() && way.time_s >= best.time_s;
      if (is_better(way, best))
        best = std::move(way);
      if (longer)
        break;
    }
    best.straight_time_s = distance / swim.speed_m_s();
    return best;
  }
} // namespace swimtwin
