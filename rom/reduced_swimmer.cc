#include <datasets/error.h>
#include <rom/reduced_swimmer.h>

#include <fmt/format.h>

#include <cmath>

// Letters as in docs/equations.md, section 14: q shape, b field in the head's frame, m moment, f generalised force,
// xi generalised velocity, phi gradient of the area, p its multiplier.

namespace swimtwin
{
  namespace
  {
    /// Columns of RateDerivatives::columns after those of the angle and the shape.
    enum ForceColumn {
      by_young_modulus,
      by_magnetization,
      by_tail_magnetization,
      by_field_x,
      by_field_y,
      n_force_columns
    };

    const ReducedModel &checked(const ReducedModel &model)
    {
      if (model.n_modes() > max_modes)
        throw InputError(
            fmt::format("the reduced model has {} modes; this program moves at most {}: use fewer of them.",
                        model.n_modes(), max_modes));
      return model;
    }

    double largest_distance(const Eigen::MatrixXd &nodes)
    {
      return nodes.rowwise().norm().maxCoeff();
    }

    Eigen::Vector2d in_head_frame(const double angle, const Eigen::Vector2d &v)
    {
      const double c = std::cos(angle), s = std::sin(angle);
      return {c * v.x() + s * v.y(), -s * v.x() + c * v.y()};
    }

    /// Turned by -90 degrees: the derivative of a vector in the head's frame by the head's angle.
    Eigen::Vector2d turned_back(const Eigen::Vector2d &v)
    {
      return {v.y(), -v.x()};
    }

    double cross(const Eigen::Vector2d &a, const Eigen::Vector2d &b)
    {
      return a.x() * b.y() - a.y() * b.x();
    }

    /// Head-frame velocities become rates of the state, in place.
    template <typename Columns>
    void turn_to_laboratory(const double angle, Columns &&velocities)
    {
      const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
      velocities.topRows(2)   = (R * velocities.topRows(2)).eval();
    }
  } // namespace

  ReducedSwimmer::ReducedSwimmer(const ReducedModel &model)
      : r_(checked(model).n_modes()), length_m_(largest_distance(model.tail.nodes_m)), tip_(model.tail),
        amplitudes_(model.tail), energy_(model.elasticity, model.tail),
        resistance_(model.resistance, model.tail.parity.head(r_)), magnet_(model.magnet), area_(model.area)
  {
  }

  double ReducedSwimmer::area_change(const ShapeVector &q) const
  {
    const AmplitudeVector p = amplitudes_.value(q);
    return area_.linear_m.dot(p) + p.dot(area_.quadratic * p);
  }

  ShapeVector ReducedSwimmer::area_gradient(const ShapeVector &q) const
  {
    return amplitudes_.slopes(q).transpose() * area_gradient_by_amplitudes(q);
  }

  AmplitudeVector ReducedSwimmer::area_gradient_by_amplitudes(const ShapeVector &q) const
  {
    return area_.linear_m + 2. * area_.quadratic * amplitudes_.value(q);
  }

  ShapeMatrix ReducedSwimmer::area_hessian(const ShapeVector &q) const
  {
    const AmplitudeMatrix J = amplitudes_.slopes(q);
    ShapeMatrix           H = amplitudes_.curvature(area_gradient_by_amplitudes(q));
    H += 2. * J.transpose() * area_.quadratic * J;
    return H;
  }

  VelocityVector ReducedSwimmer::area_direction(const ShapeVector &q) const
  {
    VelocityVector phi = VelocityVector::Zero(n_states());
    phi.tail(r_)       = area_gradient(q);
    return phi;
  }

  Eigen::Vector2d ReducedSwimmer::moment(const ShapeVector &q, const SwimmerParameters &parameters) const
  {
    return parameters.magnetization_A_m * magnet_.head_area_m2 * Eigen::Vector2d::UnitX() +
           parameters.tail_magnetization_A_m * tail_area(q);
  }

  Eigen::Vector2d ReducedSwimmer::tail_area(const ShapeVector &q) const
  {
    return magnet_.tail_area_m2 + magnet_.tail_area_of_mode_m * amplitudes_.value(q);
  }

  Eigen::Matrix2Xd ReducedSwimmer::tail_area_slopes(const ShapeVector &q) const
  {
    return magnet_.tail_area_of_mode_m * amplitudes_.slopes(q);
  }

  SwimmerMotion ReducedSwimmer::make_motion() const
  {
    SwimmerMotion motion;
    motion.velocity   = VelocityVector::Zero(n_states());
    motion.rate       = VelocityVector::Zero(n_states());
    motion.resistance = resistance_.make_factor();
    return motion;
  }

  RateDerivatives ReducedSwimmer::make_derivatives() const
  {
    RateDerivatives derivatives;
    derivatives.by_state = Eigen::MatrixXd::Zero(n_states(), n_states());
    derivatives.by_field = Eigen::MatrixXd::Zero(n_states(), 2);
    derivatives.columns  = Eigen::MatrixXd::Zero(n_states(), 1 + r_ + n_force_columns);
    return derivatives;
  }

  VelocityVector ReducedSwimmer::magnetic_force(const ShapeVector &q, const Eigen::Vector2d &moment,
                                                const Eigen::Vector2d &head_field,
                                                const double           tail_magnetization) const
  {
    VelocityVector f = VelocityVector::Zero(n_states());
    f[2]             = cross(moment, head_field);
    if (tail_magnetization != 0.)
      f.tail(r_) = tail_magnetization * (tail_area_slopes(q).transpose() * head_field);
    return f;
  }

  VelocityVector ReducedSwimmer::force(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                       const SwimmerParameters &parameters) const
  {
    const ShapeVector q = state.tail(r_);
    VelocityVector    f =
        magnetic_force(q, moment(q, parameters), in_head_frame(state[2], field_T), parameters.tail_magnetization_A_m);
    f.tail(r_) -= parameters.young_modulus_Pa * energy_.gradient(q);
    return f;
  }

  void ReducedSwimmer::solve(const ResistanceFactor &resistance, Eigen::Ref<Eigen::MatrixXd> columns) const
  {
    const auto L0 = resistance_.factor_at_rest().triangularView<Eigen::Lower>();
    const auto C  = resistance.factor.triangularView<Eigen::Lower>();
    L0.solveInPlace(columns);
    C.solveInPlace(columns);
    C.transpose().solveInPlace(columns);
    L0.transpose().solveInPlace(columns);
  }

  void ReducedSwimmer::set_velocity(const SwimmerState &state, const VelocityVector &force, const double viscosity,
                                    SwimmerMotion &motion, double &pressure) const
  {
    motion.velocity = force / viscosity;
    solve(motion.resistance, motion.velocity);
    pressure = 0.;
    if (area_.is_kept)
    {
      const VelocityVector phi         = area_direction(state.tail(r_));
      VelocityVector       by_pressure = phi;
      solve(motion.resistance, by_pressure);
      const double multiple = phi.dot(motion.velocity) / phi.dot(by_pressure);
      motion.velocity -= multiple * by_pressure;
      pressure = viscosity * multiple;
    }
    motion.rate = motion.velocity;
    turn_to_laboratory(state[2], motion.rate);
  }

  void ReducedSwimmer::set_rate(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                const SwimmerParameters &parameters, SwimmerMotion &motion) const
  {
    double pressure = 0.;
    resistance_.evaluate(state.tail(r_), state[2], motion.resistance);
    set_velocity(state, force(state, field_T, parameters), parameters.viscosity_Pa_s, motion, pressure);
  }

  void ReducedSwimmer::move(const SwimmerState &state, const Eigen::Vector2d &field_T,
                            const SwimmerParameters &parameters, SwimmerMotion &motion) const
  {
    set_rate(state, field_T, parameters, motion);
    const ShapeVector    q = state.tail(r_);
    const VelocityVector f =
        magnetic_force(q, moment(q, parameters), in_head_frame(state[2], field_T), parameters.tail_magnetization_A_m);
    const VelocityVector pulled =
        motion.resistance.factor.transpose() * (resistance_.factor_at_rest().transpose() * motion.velocity);
    motion.magnetic_power_W_m = f.dot(motion.velocity);
    motion.dissipation_W_m    = parameters.viscosity_Pa_s * pulled.squaredNorm();
    motion.elastic_power_W_m  = parameters.young_modulus_Pa * energy_.gradient(q).dot(motion.velocity.tail(r_));
  }

  void ReducedSwimmer::set_force_derivatives(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                             const SwimmerParameters &parameters, Eigen::MatrixXd &columns) const
  {
    const ShapeVector     q = state.tail(r_);
    const Eigen::Vector2d m = moment(q, parameters), b = in_head_frame(state[2], field_T);
    const double          M_tail = parameters.tail_magnetization_A_m;
    columns.setZero();
    columns.col(0)              = magnetic_force(q, m, turned_back(b), M_tail);
    columns.block(3, 1, r_, r_) = -parameters.young_modulus_Pa * energy_.hessian(q);
    if (M_tail != 0.)
    {
      const Eigen::Matrix2Xd slopes = tail_area_slopes(q);
      for (int l = 0; l < r_; ++l)
        columns(2, 1 + l) = M_tail * cross(slopes.col(l), b);
      columns.block(3, 1, r_, r_) += M_tail * amplitudes_.curvature(magnet_.tail_area_of_mode_m.transpose() * b);
    }

    auto further                           = columns.rightCols<n_force_columns>();
    further.col(by_young_modulus).tail(r_) = -energy_.gradient(q);
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
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_velocities, max_modes + 1> change(
        n_states(), m);
    for (int k = 0; k < m; ++k)
    {
      const VelocityMatrix &dC     = at.factor_derivatives[static_cast<std::size_t>(k)];
      const VelocityVector  dC_eta = dC.transpose() * eta;
      change.col(k).noalias()      = dC * w;
      change.col(k).noalias() += at.factor * dC_eta;
    }
    change = (viscosity * (L0 * (change * at.coordinate_slopes))).eval();
    columns.middleCols(1, r_) -= change.leftCols(r_);
    if (resistance_.depends_on_angle())
      columns.col(0) -= change.col(r_);
  }

  /// Of velocities: the area's rate stays zero as state and parameters change.
  void ReducedSwimmer::constrain_derivatives(const SwimmerState &state, const SwimmerMotion &motion,
                                             Eigen::MatrixXd &columns) const
  {
    const VelocityVector phi         = area_direction(state.tail(r_));
    VelocityVector       by_pressure = phi;
    solve(motion.resistance, by_pressure);
    Eigen::RowVectorXd flux = phi.transpose() * columns;
    flux.segment(1, r_) += motion.velocity.tail(r_).transpose() * area_hessian(state.tail(r_));
    columns.noalias() -= by_pressure * (flux / phi.dot(by_pressure));
  }

  void ReducedSwimmer::differentiate(const SwimmerState &state, const Eigen::Vector2d &field_T,
                                     const SwimmerParameters &parameters, SwimmerMotion &motion,
                                     RateDerivatives &derivatives) const
  {
    const double viscosity = parameters.viscosity_Pa_s;
    double       pressure  = 0.;
    resistance_.differentiate(state.tail(r_), state[2], motion.resistance);
    set_velocity(state, force(state, field_T, parameters), viscosity, motion, pressure);

    Eigen::MatrixXd &columns = derivatives.columns;
    set_force_derivatives(state, field_T, parameters, columns);
    add_resistance_derivatives(motion, viscosity, columns);
    if (area_.is_kept)
      columns.block(3, 1, r_, r_) -= pressure * area_hessian(state.tail(r_));
    columns /= viscosity;
    solve(motion.resistance, columns);
    if (area_.is_kept)
      constrain_derivatives(state, motion, columns);
    turn_to_laboratory(state[2], columns);

    derivatives.by_state.rightCols(1 + r_) = columns.leftCols(1 + r_);
    derivatives.by_state(0, 2) -= motion.rate[1]; // the frame itself turns
    derivatives.by_state(1, 2) += motion.rate[0];
    const auto further                = columns.rightCols<n_force_columns>();
    derivatives.by_young_modulus      = further.col(by_young_modulus);
    derivatives.by_magnetization      = further.col(by_magnetization);
    derivatives.by_tail_magnetization = further.col(by_tail_magnetization);
    derivatives.by_field              = further.middleCols<2>(by_field_x);
    derivatives.rate                  = motion.rate;
    derivatives.by_viscosity          = -motion.rate / viscosity;
  }

  Eigen::Vector3d ReducedSwimmer::head_velocity(const SwimmerState &state, const ShapeVector &shape_rate,
                                                const double torque_N, const double viscosity_Pa_s,
                                                ResistanceFactor &resistance) const
  {
    resistance_.evaluate(state.tail(r_), state[2], resistance);
    const VelocityMatrix  L        = resistance_.factor_at_rest() * resistance.factor;
    const Eigen::Matrix3d rigid    = L.topRows<3>() * L.topRows<3>().transpose();
    const Eigen::Vector3d by_shape = L.topRows<3>() * (L.bottomRows(r_).transpose() * shape_rate);
    const Eigen::Vector3d load     = Eigen::Vector3d(0., 0., torque_N / viscosity_Pa_s) - by_shape;
    return rigid.llt().solve(load);
  }

  SwimmerState state_at_rest(const ReducedSwimmer &swimmer, const double angle_rad)
  {
    SwimmerState state = SwimmerState::Zero(swimmer.n_states());
    state[2]           = angle_rad;
    return state;
  }
} // namespace swimtwin
