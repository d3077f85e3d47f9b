#include <rom/swimmer/force_columns.h>
#include <rom/swimmer/head_frame.h>
#include <rom/swimmer/reduced_swimmer.h>

#include <cmath>

// The swimmer with inertia (docs/equations.md, section 14): M dxi/dt = f - mu R xi - h, h = 1/2 dM/dt xi + (xi . N xi).

namespace swimtwin
{
  Eigen::VectorXd ReducedSwimmer::variable_rate(const SwimmerState &state, const ResistanceFactor &at) const
  {
    const auto     velocity = state.tail(n_velocities());
    VelocityVector rates(r_ + 2); // of shape, angle and height
    rates << velocity.tail(r_), velocity[2], std::sin(state[2]) * velocity[0] + std::cos(state[2]) * velocity[1];
    return at.coordinate_slopes * rates;
  }

  Eigen::MatrixXd ReducedSwimmer::variable_rate_by_velocity(const SwimmerState &state, const ResistanceFactor &at) const
  {
    const auto     &slopes = at.coordinate_slopes;
    Eigen::MatrixXd by_velocity(slopes.rows(), n_velocities());
    by_velocity.col(0)        = std::sin(state[2]) * slopes.col(r_ + 1);
    by_velocity.col(1)        = std::cos(state[2]) * slopes.col(r_ + 1);
    by_velocity.col(2)        = slopes.col(r_);
    by_velocity.rightCols(r_) = slopes.leftCols(r_);
    return by_velocity;
  }

  void ReducedSwimmer::set_inertial_rate(const SwimmerState &state, const VelocityVector &force, const double viscosity,
                                         SwimmerMotion &motion) const
  {
    const int n     = n_velocities();
    motion.velocity = state.tail(n);
    resistance_.set_coordinate_slopes(shape_of(state), state[2], state[1], motion.resistance);
    inertia_.evaluate(motion.resistance.coordinates, variable_rate(state, motion.resistance), motion.velocity,
                      motion.inertia);
    motion.rate.resize(2 * n);
    motion.rate.head(n) = motion.velocity;
    turn_to_laboratory(state[2], motion.rate.head(n));
    motion.rate.tail(n) = motion.inertia.mass.llt().solve(force - drag(motion, viscosity) - motion.inertia.force);
  }

  /// - (dh + dM dxi/dt) for the angle, the shape and the height.
  void ReducedSwimmer::add_inertia_derivatives(const SwimmerState &state, const SwimmerMotion &motion,
                                               Eigen::MatrixXd &columns) const
  {
    const auto          &v            = motion.inertia;
    const auto          &slopes       = motion.resistance.coordinate_slopes;
    const VelocityVector acceleration = motion.rate.tail(n_velocities());
    Eigen::MatrixXd      change       = v.force_by_variable;
    for (Eigen::Index c = 0; c < change.cols(); ++c)
      change.col(c) += v.mass_slopes[static_cast<std::size_t>(c)] * acceleration;
    const Eigen::MatrixXd rate_slopes = resistance_.variable_rate_slopes(
        shape_of(state), state[2], state[1], motion.velocity.tail(r_), motion.velocity[2], motion.rate[1]);
    Eigen::MatrixXd all = change * slopes + v.force_by_rate * rate_slopes;
    all.col(r_) += v.force_by_rate * (motion.rate[0] * slopes.col(r_ + 1)); // the head's frame turns
    columns.middleCols(1, r_) -= all.leftCols(r_);
    columns.col(0) -= all.col(r_);
    columns.rightCols<n_force_columns>().col(by_height) -= all.col(r_ + 1);
  }

  void ReducedSwimmer::differentiate_inertial(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                              const SwimmerParameters &parameters, SwimmerMotion &motion,
                                              RateDerivatives &derivatives) const
  {
    const int          n         = n_velocities();
    const double       viscosity = parameters.viscosity_Pa_s;
    const EnergySlopes energy    = energy_.differentiate(shape_of(state));
    resistance_.differentiate(shape_of(state), state[2], state[1], motion.resistance);
    set_inertial_rate(state, force(state, field_T, parameters, energy.gradient), viscosity, motion);
    inertia_.differentiate(motion.resistance.coordinates, variable_rate(state, motion.resistance), motion.velocity,
                           motion.inertia);

    Eigen::MatrixXd &columns = derivatives.columns;
    set_force_derivatives(state, field_T, parameters, energy, columns);
    add_resistance_derivatives(motion, viscosity, columns);
    add_inertia_derivatives(state, motion, columns);

    const auto           &L0       = resistance_.factor_at_rest();
    const VelocityMatrix  L        = L0 * motion.resistance.factor;
    const Eigen::MatrixXd by_rate  = motion.inertia.force_by_rate;
    Eigen::MatrixXd       velocity = -viscosity * L * L.transpose() - motion.inertia.force_by_velocity -
                               by_rate * variable_rate_by_velocity(state, motion.resistance);
    const Eigen::LLT<VelocityMatrix> M(motion.inertia.mass);
    M.solveInPlace(columns);
    M.solveInPlace(velocity);

    auto &by_state = derivatives.by_state;
    by_state.setZero();
    by_state(0, 2)                = -motion.rate[1]; // the frame itself turns
    by_state(1, 2)                = motion.rate[0];
    by_state.topRightCorner(n, n) = Eigen::MatrixXd::Identity(n, n);
    turn_to_laboratory(state[2], by_state.topRightCorner(n, n));
    by_state.bottomRightCorner(n, n) = velocity;
    by_state.block(n, 2, n, 1 + r_)  = columns.leftCols(1 + r_);
    const auto further               = columns.rightCols<n_force_columns>();
    by_state.block(n, 1, n, 1)       = further.col(by_height);

    const auto lower = [&](const Eigen::VectorXd &column) {
      VelocityVector whole = VelocityVector::Zero(2 * n);
      whole.tail(n)        = column;
      return whole;
    };
    derivatives.by_young_modulus      = lower(further.col(by_young_modulus));
    derivatives.by_magnetization      = lower(further.col(by_magnetization));
    derivatives.by_tail_magnetization = lower(further.col(by_tail_magnetization));
    derivatives.by_viscosity          = lower(M.solve(-drag(motion, 1.)));
    derivatives.by_field.setZero();
    derivatives.by_field.bottomRows(n) = further.middleCols<2>(by_field_x);
    derivatives.rate                   = motion.rate;
  }
} // namespace swimtwin
