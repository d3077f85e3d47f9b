#include <rom/swimmer/force_columns.h>
#include <rom/swimmer/head_frame.h>
#include <rom/swimmer/reduced_swimmer.h>

// Letters as in docs/equations.md, section 14: q shape, b field in the head's frame, m moment, f generalised force,
// xi generalised velocity, phi gradient of the area, p its multiplier. From
//
//   mu R xi = f - p phi,  phi . xi = 0   follows   mu R dxi = df - p dphi - mu dR xi - dp phi,  phi . dxi = -dphi . xi.

namespace swimtwin
{
  namespace
  {
    /// Turned by -90 degrees: the derivative of a vector in the head's frame by the head's angle.
    Eigen::Vector2d turned_back(const Eigen::Vector2d &v)
    {
      return {v.y(), -v.x()};
    }
  } // namespace

  RateDerivatives ReducedSwimmer::make_derivatives() const
  {
    RateDerivatives derivatives;
    derivatives.by_state = Eigen::MatrixXd::Zero(n_states(), n_states());
    derivatives.by_field = Eigen::MatrixXd::Zero(n_states(), 2);
    derivatives.columns  = Eigen::MatrixXd::Zero(n_velocities(), 1 + r_ + n_force_columns);
    return derivatives;
  }

  void ReducedSwimmer::set_force_derivatives(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                             const SwimmerParameters &parameters, const EnergySlopes &energy,
                                             Eigen::MatrixXd &columns) const
  {
    const ShapeVector     q = shape_of(state);
    const Eigen::Vector2d m = moment(q, parameters), b = in_head_frame(state[2], field_T);
    const double          M_tail = parameters.tail_magnetization_A_m;
    columns.setZero();
    columns.col(0)              = magnetic_force(q, m, turned_back(b), M_tail);
    columns.block(3, 1, r_, r_) = -parameters.young_modulus_Pa * energy.hessian;
    if (M_tail != 0.)
    {
      const Eigen::Matrix2Xd slopes = tail_area_slopes(q);
      for (int l = 0; l < r_; ++l)
        columns(2, 1 + l) = M_tail * cross(slopes.col(l), b);
      columns.block(3, 1, r_, r_) += M_tail * amplitudes_.curvature(q, magnet_.tail_area_of_mode_m.transpose() * b);
    }

    auto further                           = columns.rightCols<n_force_columns>();
    further.col(by_young_modulus).tail(r_) = -energy.gradient;
    further(2, by_magnetization)           = magnet_.head_area_m2 * b.y();
    further.col(by_tail_magnetization)     = magnetic_force(q, tail_area(q), b, 1.);
    further.col(by_field_x) = magnetic_force(q, m, in_head_frame(state[2], Eigen::Vector2d::UnitX()), M_tail);
    further.col(by_field_y) = magnetic_force(q, m, in_head_frame(state[2], Eigen::Vector2d::UnitY()), M_tail);
  }

  /// - viscosity dR xi for the angle and the shape.
  void ReducedSwimmer::add_resistance_derivatives(const SwimmerMotion &motion, const double viscosity,
                                                  Eigen::MatrixXd &columns) const
  {
    const auto          &L0  = resistance_.factor_at_rest();
    const auto          &at  = motion.resistance;
    const VelocityVector eta = L0.transpose() * motion.velocity, w = at.factor.transpose() * eta;
    const int            m = resistance_.n_coordinates();
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_velocities, max_modes + 2> change(
        n_velocities(), m);
    for (int k = 0; k < m; ++k)
    {
      const VelocityMatrix &dC     = at.factor_derivatives[static_cast<std::size_t>(k)];
      const VelocityVector  dC_eta = dC.transpose() * eta;
      change.col(k).noalias()      = dC * w;
      change.col(k).noalias() += at.factor * dC_eta;
    }
    change = (viscosity * (L0 * (change * at.coordinate_slopes))).eval();
    columns.middleCols(1, r_) -= change.leftCols(r_);
    columns.col(0) -= change.col(r_);
    columns.rightCols<n_force_columns>().col(by_height) -= change.col(r_ + 1);
  }

  /// Of velocities: the area's rate stays zero as state and parameters change.
  void ReducedSwimmer::constrain_derivatives(const SwimmerState &state, const SwimmerMotion &motion,
                                             Eigen::MatrixXd &columns) const
  {
    const VelocityVector phi         = area_direction(shape_of(state));
    VelocityVector       by_pressure = phi;
    solve(motion.resistance, by_pressure);
    Eigen::RowVectorXd flux = phi.transpose() * columns;
    flux.segment(1, r_) += motion.velocity.tail(r_).transpose() * area_hessian(shape_of(state));
    columns.noalias() -= by_pressure * (flux / phi.dot(by_pressure));
  }

  void ReducedSwimmer::differentiate(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                     const SwimmerParameters &parameters, SwimmerMotion &motion,
                                     RateDerivatives &derivatives) const
  {
    if (has_inertia_)
      return differentiate_inertial(state, field_T, parameters, motion, derivatives);
    const double       viscosity = parameters.viscosity_Pa_s;
    double             pressure  = 0.;
    const EnergySlopes energy    = energy_.differentiate(shape_of(state));
    resistance_.differentiate(shape_of(state), state[2], state[1], motion.resistance);
    set_velocity(state, force(state, field_T, parameters, energy.gradient), viscosity, motion, pressure);

    Eigen::MatrixXd &columns = derivatives.columns;
    set_force_derivatives(state, field_T, parameters, energy, columns);
    add_resistance_derivatives(motion, viscosity, columns);
    if (area_.is_kept)
      columns.block(3, 1, r_, r_) -= pressure * area_hessian(shape_of(state));
    columns /= viscosity;
    solve(motion.resistance, columns);
    if (area_.is_kept)
      constrain_derivatives(state, motion, columns);
    turn_to_laboratory(state[2], columns);

    derivatives.by_state.rightCols(1 + r_) = columns.leftCols(1 + r_);
    derivatives.by_state(0, 2) -= motion.rate[1]; // the frame itself turns
    derivatives.by_state(1, 2) += motion.rate[0];
    const auto further                = columns.rightCols<n_force_columns>();
    derivatives.by_state.col(1)       = further.col(by_height);
    derivatives.by_young_modulus      = further.col(by_young_modulus);
    derivatives.by_magnetization      = further.col(by_magnetization);
    derivatives.by_tail_magnetization = further.col(by_tail_magnetization);
    derivatives.by_field              = further.middleCols<2>(by_field_x);
    derivatives.rate                  = motion.rate;
    derivatives.by_viscosity          = -motion.rate / viscosity;
  }
} // namespace swimtwin
