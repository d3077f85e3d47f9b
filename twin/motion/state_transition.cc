#include <rom/swimmer/state_scale.h>
#include <twin/motion/state_transition.h>

#include <limits>

// Letters: u = (angle, shape), before them the height if the resistance depends on it, behind them the velocities of
// a swimmer with inertia; F = du/dt, J = dF/du,
// Z_i = u_i - u_0 at the stages, h length of the step: Z_i = h sum_j A_ij F(u_0 + Z_j). What is left of the position
// follows by the same rule, because nothing depends on it.

namespace swimtwin
{
  namespace
  {
    constexpr double newton_tolerance       = 1e-6; // of a radian and of a stroke; what is left is about its square
    constexpr int    n_corrections_by_start = 2;    // each costs a tenth of one with new slopes
    constexpr int    max_newton_iterations  = 12;
    constexpr double largest_correction     = 3.; // radians or strokes: beyond that it is lost
  }                                               // namespace

  StateTransition::StateTransition(const ReducedSwimmer &swimmer)
      : swimmer_(swimmer), n_(swimmer.n_states()), k_(n_ - 2 + swimmer.resistance().depends_on_height()),
        free_(n_ - k_), rule_(radau_rule()), motion_(swimmer.make_motion()), increments_(n_stages * k_),
        correction_(n_stages * k_), matrix_(n_stages * k_, n_stages * k_), factors_(n_stages * k_),
        loads_(n_stages * k_, k_ + n_step_parameters), inputs_(n_, n_step_parameters), by_start_(n_, n_),
        by_parameters_(n_, n_step_parameters), scale_(state_scale(swimmer))
  {
    stages_.fill(swimmer.make_derivatives());
  }

  void StateTransition::evaluate_stages(const SwimmerState &start, const SwimmerParameters &parameters,
                                        const bool with_slopes)
  {
    for (int i = 0; i < n_stages; ++i)
    {
      SwimmerState state = start;
      state.tail(k_) += increments_.segment(i * k_, k_);
      const auto       place = static_cast<std::size_t>(i);
      RateDerivatives &stage = stages_[place];
      if (with_slopes)
        swimmer_.differentiate(state, fields_T_[place], parameters, motion_, stage);
      else
      {
        swimmer_.set_rate(state, fields_T_[place], parameters, motion_);
        stage.rate = motion_.rate;
      }
    }
  }

  void StateTransition::set_matrix(const double length, const bool at_start)
  {
    matrix_.setIdentity(n_stages * k_, n_stages * k_);
    for (int j = 0; j < n_stages; ++j)
    {
      const auto J = stages_[at_start ? 0 : static_cast<std::size_t>(j)].by_state.bottomRightCorner(k_, k_);
      for (int i = 0; i < n_stages; ++i)
        matrix_.block(i * k_, j * k_, k_, k_) -= length * rule_.A(i, j) * J;
    }
    factors_.compute(matrix_);
  }

  /// Increments of the equations linearised at the start: a step that depends on nothing before it.
  void StateTransition::guess_increments(const double length, const SwimmerState &start,
                                         const SwimmerParameters &parameters)
  {
    RateDerivatives &at_start = stages_.front();
    swimmer_.differentiate(start, start_field_T_, parameters, motion_, at_start);
    set_matrix(length, true);
    increments_.setZero();
    for (int j = 0; j < n_stages; ++j)
    {
      const Eigen::Vector2d change = fields_T_[static_cast<std::size_t>(j)] - start_field_T_;
      for (int i = 0; i < n_stages; ++i)
        increments_.segment(i * k_, k_) +=
            length * rule_.A(i, j) * (at_start.rate.tail(k_) + at_start.by_field.bottomRows(k_).lazyProduct(change));
    }
    increments_ = factors_.solve(increments_).eval();
  }

  /// Newton's correction of the increments with the factors at hand. Returns its size.
  double StateTransition::correct_increments(const double length)
  {
    correction_ = -increments_;
    for (int i = 0; i < n_stages; ++i)
      for (int j = 0; j < n_stages; ++j)
        correction_.segment(i * k_, k_) += length * rule_.A(i, j) * stages_[static_cast<std::size_t>(j)].rate.tail(k_);
    correction_ = factors_.solve(correction_).eval();
    increments_ += correction_;
    double size = 0.;
    for (int i = 0; i < n_stages; ++i)
      size = std::max(size, correction_.segment(i * k_, k_).cwiseQuotient(scale_.tail(k_)).lpNorm<Eigen::Infinity>());
    return correction_.allFinite() ? size : std::numeric_limits<double>::infinity();
  }

  /// First with the slopes at the start, for which rates are enough; then with those of the stages.
  bool StateTransition::solve_stages(const double length, const SwimmerState &start,
                                     const SwimmerParameters &parameters)
  {
    guess_increments(length, start, parameters);
    for (int iteration = 0; iteration < n_corrections_by_start; ++iteration)
    {
      evaluate_stages(start, parameters, false);
      if (correct_increments(length) > largest_correction * (iteration == 0 ? 10. : 1.))
        return false;
    }
    for (int iteration = 0; iteration < max_newton_iterations; ++iteration)
    {
      evaluate_stages(start, parameters, true);
      set_matrix(length, false);
      const double size = correct_increments(length);
      if (size > largest_correction)
        return false;
      if (size < newton_tolerance)
        return true;
    }
    return false;
  }

  void StateTransition::set_derivatives(const double length, const SwimmerParameters &parameters)
  {
    const auto set_inputs = [&](const RateDerivatives &stage) {
      inputs_.col(log_stiffness)     = parameters.young_modulus_Pa * stage.by_young_modulus;
      inputs_.col(log_magnetization) = parameters.magnetization_A_m * stage.by_magnetization +
                                       parameters.tail_magnetization_A_m * stage.by_tail_magnetization;
      inputs_.middleCols<2>(background_x) = stage.by_field;
    };
    loads_.setZero();
    by_parameters_.setZero();
    for (int i = 0; i < n_stages; ++i)
      loads_.block(i * k_, 0, k_, k_).setIdentity();
    for (int j = 0; j < n_stages; ++j)
    {
      set_inputs(stages_[static_cast<std::size_t>(j)]);
      for (int i = 0; i < n_stages; ++i)
        loads_.block(i * k_, k_, k_, n_step_parameters) += length * rule_.A(i, j) * inputs_.bottomRows(k_);
      by_parameters_.topRows(free_) += length * rule_.A(n_stages - 1, j) * inputs_.topRows(free_);
    }
    loads_ = factors_.solve(loads_);

    by_start_.setIdentity();
    for (int j = 0; j < n_stages; ++j)
    {
      const double weight = length * rule_.A(n_stages - 1, j);
      const auto   slopes = stages_[static_cast<std::size_t>(j)].by_state.topRightCorner(free_, k_);
      by_start_.topRightCorner(free_, k_) += weight * slopes.lazyProduct(loads_.block(j * k_, 0, k_, k_));
      by_parameters_.topRows(free_) += weight * slopes.lazyProduct(loads_.block(j * k_, k_, k_, n_step_parameters));
    }
    by_start_.bottomRightCorner(k_, k_) = loads_.block((n_stages - 1) * k_, 0, k_, k_);
    by_parameters_.bottomRows(k_)       = loads_.block((n_stages - 1) * k_, k_, k_, n_step_parameters);
  }

  bool StateTransition::advance(const FieldSignal &field, const double from_s, const double to_s,
                                const SwimmerParameters &parameters, const Eigen::Vector2d &background_T,
                                SwimmerState &state)
  {
    const double length = to_s - from_s;
    start_field_T_      = field.value_T(from_s) + background_T;
    for (int i = 0; i < n_stages; ++i)
      fields_T_[static_cast<std::size_t>(i)] = field.value_T(from_s + rule_.c[i] * length) + background_T;
    if (!solve_stages(length, state, parameters))
      return false;
    set_derivatives(length, parameters);
    for (int j = 0; j < n_stages; ++j)
    {
      const RateDerivatives &stage = stages_[static_cast<std::size_t>(j)];
      state.head(free_) += length * rule_.A(n_stages - 1, j) *
                           (stage.rate.head(free_) +
                            stage.by_state.topRightCorner(free_, k_).lazyProduct(correction_.segment(j * k_, k_)));
    }
    state.tail(k_) += increments_.tail(k_);
    return true;
  }
} // namespace swimtwin
